// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/fixed_vector.hpp"
#include "core/base/tuning.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/odometry_covariance.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Most scans that one multiscan holds.
inline constexpr std::size_t kMaxMultiscanScans = 128;
/// Most points that one multiscan holds.
inline constexpr std::size_t kMaxMultiscanPoints = 512;

struct MultiscanPoint {
  Point2 p_body;         ///< in the present body frame
  Point2 direction;      ///< unit vector of the beam in the present body frame: its error lies along it
  std::uint16_t scan{};  ///< counts from the oldest scan, 0
  std::uint8_t beam{};
};

/// The points of several scans in the frame of the present pose.
struct MultiscanView {
  FixedVector<MultiscanPoint, kMaxMultiscanPoints> points;  ///< scan by scan, oldest first, beams in order
  /// The error of the motion from scan j to j + 1 displaces all points of the scans 0..j together, by
  /// p += (v_x, v_y) + w * (-p.y, p.x). Covariance of (v_x, v_y, w), m^2, m rad, rad^2. The newest scan is
  /// the present one: there is one entry fewer than scans.
  FixedVector<Eigen::Matrix3d, kMaxMultiscanScans> motion_covariance;
  /// Scans that were not in the previous view.
  std::size_t new_scans = 0;
  std::size_t scans = 0;
};

struct MultiscanTuning {
  double min_motion_m = 0.01;          ///< smaller motions since the scan before ...
  double min_turn_rad = radians(1.0);  ///< ... and smaller turns do not make a new scan

  static constexpr TuningValue<MultiscanTuning> kValues[] = {
      {"min_motion_m", &MultiscanTuning::min_motion_m}, {"min_turn_rad", &MultiscanTuning::min_turn_rad}};
};

/// The last k scans (eqs. 1-4 of "Efficient 2D Graph SLAM for Sparse Sensing", IROS 2022). The paper gives
/// each point a covariance of its own (eqs. 16-18) and treats the points as uncorrelated; but an error of the
/// dead reckoning moves all older points together. So the view keeps the error of each motion, from which eq.
/// 16 follows for one point and the covariance of a line for many. Scans without motion between them add
/// nothing and would displace others: each replaces the one before.
/// @note Fixed storage. One thread at a time.
class Multiscan {
 public:
  /// Holds ceil(points / beams) scans, at least 2. Precondition: points + beams.count - 1 <=
  /// kMaxMultiscanPoints.
  Multiscan(const SensorModel& sensor, const BeamLayout& beams, std::size_t points,
            const MultiscanTuning& tuning = {});

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Removes all scans: the motion from them to the next is unknown.
  void restart();
  /// `step`: motion from the sample added before to this one (ignored for the first after a restart). Only
  /// hits are kept.
  void add(const RangeSample& sample, const UncertainMotion& step);
  /// Moves all points into the frame of the newest sample (eq. 4).
  void assemble(MultiscanView& view);

 private:
  struct Scan {
    UncertainMotion motion;                       // from the scan before to this one
    FixedVector<MultiscanPoint, kMaxBeams> hits;  // in the frame of this scan
    bool in_a_view = false;
  };

  Scan& scan(std::size_t i) { return ring_[(oldest_ + i) % kMaxMultiscanScans]; }
  [[nodiscard]] bool is_short(const Pose2& motion) const;
  void push_empty_scan();
  void read_hits(const RangeSample& sample, Scan& scan) const;

  MultiscanTuning tuning_;
  std::size_t scan_limit_;
  double min_range_m_;
  double max_range_m_;
  std::array<Point2, kMaxBeams> direction_{};
  std::array<Scan, kMaxMultiscanScans> ring_{};
  std::size_t oldest_ = 0;
  std::size_t size_ = 0;
};

}  // namespace swiftlet
