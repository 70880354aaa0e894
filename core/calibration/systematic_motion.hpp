// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/calibration/calibration_scan.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// The estimated errors, in the order of SystematicErrors.
enum class SystematicError : std::size_t {
  kRangeAge,       ///< s: how much older the ranges are than assumed
  kForwardScale,   ///< OdometryCalibration::forward_scale less 1
  kSidewaysScale,  ///< OdometryCalibration::sideways_scale less 1
  kYawPerMetre,    ///< these as in OdometryCalibration
  kYawPerRadian,
  kYawPerSecond,
};
inline constexpr std::size_t kSystematicErrors = 6;
using SystematicErrors = Eigen::Matrix<double, kSystematicErrors, 1>;
constexpr Eigen::Index index_of(SystematicError error) { return static_cast<Eigen::Index>(error); }

/// Whether the yaw comes from wheels, whose errors grow with travel; a gyro's grow with time.
inline bool yaw_goes_with_travel(const OdometryNoise& noise) { return noise.drift_yaw_per_metre_rad > 0.0; }

/// Median of the times from one scan to the next; 0 for fewer than two scans.
[[nodiscard]] double usual_interval_s(std::span<const CalibrationScan> scans);

/// Stamps that come in bunches give no velocity: both intervals around a scan must be near the usual one.
struct SystematicMotionTuning {
  double min_share = 0.5;  ///< of the usual interval
  double max_share = 2.0;
};

/// Predicts the dead reckoning of the steps between neighbouring scans from its systematic errors. The time
/// offset moves each scan along its twist, a central difference over its neighbours: so the noise of a step
/// is in no derivative of that step and does not draw the estimate towards smoother odometry.
class SystematicMotion {
 public:
  /// Allocates here only. `scans` must outlive it.
  explicit SystematicMotion(std::span<const CalibrationScan> scans,
                            const SystematicMotionTuning& tuning = {});

  /// Whether the step from scan `i - 1` to scan `i` was measured; i >= 1.
  [[nodiscard]] bool is_known(std::size_t i) const { return !scans_[i].starts_segment; }
  /// The step from scan `i - 1` to scan `i` as measured; i >= 1.
  [[nodiscard]] Pose2 measured(std::size_t i) const;
  /// The same step as it would be measured without noise if the vehicle truly moved by `T_previous_this`
  /// from the time of one scan's ranges to that of the next one's. Where the dead reckoning did not move,
  /// nothing counts as missed.
  [[nodiscard]] Pose2 predicted(std::size_t i, const Pose2& T_previous_this,
                                const SystematicErrors& errors) const;

 private:
  std::span<const CalibrationScan> scans_;
  std::vector<Eigen::Vector3d> twists_;  // m/s, m/s, rad/s in the body frame; zero where unknown
};

}  // namespace swiftlet
