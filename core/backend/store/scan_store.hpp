// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ids.hpp"
#include "core/base/index_removal.hpp"
#include "core/base/time.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

using ScanIndex = std::uint32_t;  ///< counts up from 0; what is pruned gives way
using ScanRange = IndexRange;

/// One beam of a stored scan; beams without information are not stored.
struct ScanReturn {
  float distance_m = 0.0F;  ///< hit: to the surface; no return: free up to the sensor's range
  std::uint8_t beam = 0;
  bool is_hit = false;
};

/// One scan as the backend remembers it: about 250 bytes with four beams.
struct StoredScan {
  HostTime stamp{};
  std::uint32_t number = 0;  ///< counts all scans of the run, those pruned too
  Pose2 T_odom_body;
  Pose2 T_dead_body;      ///< dead reckoning less its learnt drift
  Pose2 T_keyframe_body;  ///< by dead reckoning from `keyframe`
  Pose2 T_map_live;       ///< the body in the map as it was published at the time
  KeyframeId keyframe{};  ///< the newest keyframe at the time, as numbered without those pruned
  double path_m = 0.0;    ///< travelled since the start of the run
  std::uint32_t first_return = 0;
  std::uint16_t return_count = 0;
  bool starts_segment = false;
  bool odometry_ran_on = false;  ///< as RangeSample's
};

/// Every scan of a run but those pruned, in order. Allocates as it grows. One thread at a time.
class ScanStore {
 public:
  explicit ScanStore(const BeamLayout& beams) : beams_(beams) {}

  ScanIndex add(const FrontendStep& step);
  /// Forgets scans together with their keyframes. After a hole begins a segment.
  void remove(const IndexRemoval& scans, const IndexRemoval& keyframes);
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  [[nodiscard]] const StoredScan& operator[](ScanIndex i) const { return scans_[i]; }
  [[nodiscard]] std::span<const ScanReturn> returns(ScanIndex i) const {
    return {returns_.data() + scans_[i].first_return, scans_[i].return_count};
  }
  [[nodiscard]] std::size_t return_count(const ScanRange& scans) const {
    if (scans.size() == 0) return 0;
    const StoredScan& last = scans_[scans.end - 1];
    return last.first_return + last.return_count - scans_[scans.first].first_return;
  }
  [[nodiscard]] const BeamLayout& beams() const { return beams_; }
  /// Where a return lies in the body frame.
  [[nodiscard]] Point2 point_body(const ScanReturn& r) const {
    return {static_cast<double>(r.distance_m) * direction_[r.beam].x_m,
            static_cast<double>(r.distance_m) * direction_[r.beam].y_m};
  }

 private:
  BeamLayout beams_;
  std::array<Point2, kMaxBeams> direction_ = unit_directions(beams_);
  std::vector<StoredScan> scans_;
  std::vector<ScanReturn> returns_;
  std::uint32_t next_number_ = 0;
  std::uint32_t keyframes_removed_ = 0;

  static std::array<Point2, kMaxBeams> unit_directions(const BeamLayout& beams);
};

}  // namespace swiftlet
