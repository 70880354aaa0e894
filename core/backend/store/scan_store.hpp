// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/id_map.hpp"
#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

using ScanRange = IdRange<ScanId>;

/// One beam of a stored scan; beams without information are not stored.
struct ScanReturn {
  float distance_m = 0.0F;  ///< hit: to the surface; no return: free up to the sensor's range
  std::uint8_t beam = 0;
  bool is_hit = false;
};

/// One scan as the backend stores it: about 250 bytes with four beams.
struct StoredScan {
  HostTime stamp{};
  DeviceTime measured_at{};
  Pose2 T_odom_body;
  Pose2 T_dead_body;      ///< dead reckoning less its learnt drift
  Pose2 T_keyframe_body;  ///< by dead reckoning from `keyframe`
  Pose2 T_map_live;       ///< the body in the map as it was published at the time
  KeyframeId keyframe{};  ///< the newest keyframe at the time
  double path_m = 0.0;    ///< travelled since the start of the run
  std::uint32_t first_return = 0;
  std::uint16_t return_count = 0;
  bool starts_segment = false;
  bool odometry_ran_on = false;  ///< as RangeSample's
  StoreyId storey{};             ///< likewise
};

/// Every scan of a run but those pruned, in order. Allocates as it grows. One thread at a time.
class ScanStore {
 public:
  explicit ScanStore(const BeamLayout& beams) : beams_(beams) {}

  ScanId add(const FrontendStep& step);
  /// After a hole begins a segment.
  void erase(const IdRanges<ScanId>& pruned);
  [[nodiscard]] const IdMap<ScanId, StoredScan>& all() const { return scans_; }
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  /// Scans with returns: those of a landed vehicle have none.
  [[nodiscard]] std::size_t seeing() const { return seeing_; }
  [[nodiscard]] std::size_t seeing(const ScanRange& range) const;
  [[nodiscard]] const StoredScan& operator[](ScanId id) const { return scans_[id]; }
  [[nodiscard]] std::span<const ScanReturn> returns(const StoredScan& scan) const {
    return {returns_.data() + scan.first_return, scan.return_count};
  }
  [[nodiscard]] std::span<const ScanReturn> returns(ScanId id) const { return returns(scans_[id]); }
  [[nodiscard]] std::size_t return_count(const ScanRange& range) const {
    const std::span<const StoredScan> scans = scans_.values(range);
    if (scans.empty()) return 0;
    return scans.back().first_return + scans.back().return_count - scans.front().first_return;
  }
  /// The samples that the scans were made of. Precondition: none was erased. Allocates.
  [[nodiscard]] std::vector<RangeSample> samples() const;
  [[nodiscard]] const BeamLayout& beams() const { return beams_; }
  /// Where a return lies in the body frame.
  [[nodiscard]] Point2 point_body(const ScanReturn& r) const {
    return {static_cast<double>(r.distance_m) * direction_[r.beam].x_m,
            static_cast<double>(r.distance_m) * direction_[r.beam].y_m};
  }

 private:
  BeamLayout beams_;
  std::array<Point2, kMaxBeams> direction_ = unit_directions(beams_);
  IdMap<ScanId, StoredScan> scans_;
  std::vector<ScanReturn> returns_;
  std::size_t seeing_ = 0;

  static std::array<Point2, kMaxBeams> unit_directions(const BeamLayout& beams);
};

}  // namespace swiftlet
