// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// The dead reckoning of a scan.
struct TimedOdometry {
  DeviceTime measured_at{};  ///< when its ranges were measured, by the assumed range age
  Pose2 T_odom_body;         ///< the dead reckoning of that time, as measured
  bool starts_segment = false;
};

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

/// Its setting in the section [sensor] of a configuration file.
[[nodiscard]] const char* setting_of(SystematicError error);
/// ... and the value of that in a sensor model.
[[nodiscard]] double value_in(const SensorModel& sensor, SystematicError error);

/// Whether the yaw comes from wheels, whose errors grow with travel; a gyro's grow with time.
inline bool yaw_goes_with_travel(const OdometryNoise& noise) { return noise.drift_yaw_per_metre_rad > 0.0; }

/// Median of the times from one scan to the next; 0 for fewer than two scans.
[[nodiscard]] double usual_interval_s(std::span<const TimedOdometry> scans);

/// Stamps that come in bunches give no velocity: both intervals around a scan must be near the usual one.
struct SystematicMotionTuning {
  double min_share = 0.5;  ///< of the usual interval
  double max_share = 2.0;
};

/// A step of dead reckoning without its systematic errors, and its derivative with respect to them.
struct CorrectedStep {
  Pose2 T_previous_this;
  Eigen::Matrix<double, 3, kSystematicErrors> by_errors;
};

/// Takes the systematic errors out of the steps between neighbouring scans. A time offset moves each scan
/// along the dead reckoning; its derivative is a central difference over the neighbours: so the noise of a
/// step is in no derivative of that step and does not draw the estimate towards smoother odometry. A scan
/// moves by its own twist where the dead reckoning around that time is unknown, and not at all where the
/// intervals around the scan are unusual.
class SystematicMotion {
 public:
  /// Allocates here only.
  explicit SystematicMotion(std::vector<TimedOdometry> scans, const SystematicMotionTuning& tuning = {});

  /// Whether the step from scan `i - 1` to scan `i` was measured; i >= 1.
  [[nodiscard]] bool is_known(std::size_t i) const { return !scans_[i].starts_segment; }
  /// Whether a time offset would show: most scans are at usual intervals.
  [[nodiscard]] bool shows_time_offset() const;
  /// The step from scan `i - 1` to scan `i` as measured; i >= 1.
  [[nodiscard]] Pose2 measured(std::size_t i) const;
  /// The corrected steps to each scan (the first has none); valid until the next call. Where the dead
  /// reckoning did not move, nothing counts as missed.
  std::span<const CorrectedStep> correct(const SystematicErrors& errors);

 private:
  /// A scan's dead reckoning as it was some time before the scan.
  struct Earlier {
    Pose2 T_odom_body;
    Eigen::Vector3d by_time;  // its derivative with respect to that time, in the odometry's frame
  };
  [[nodiscard]] Earlier earlier(std::size_t i, double seconds) const;
  [[nodiscard]] CorrectedStep corrected(std::size_t i, const Earlier& before, const Earlier& here,
                                        const SystematicErrors& errors) const;

  std::vector<TimedOdometry> scans_;
  std::vector<bool> is_usual_;           // the interval before each scan
  std::vector<bool> has_twist_;          // each scan: the intervals around it are usual
  std::vector<Eigen::Vector3d> twists_;  // m/s, m/s, rad/s in the body frame; zero where unknown
  std::vector<CorrectedStep> corrected_;
};

}  // namespace swiftlet
