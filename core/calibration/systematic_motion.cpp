// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_motion.hpp"

#include <algorithm>
#include <cstddef>

namespace swiftlet {
namespace {

double seconds_between(const CalibrationScan& before, const CalibrationScan& after) {
  return to_seconds(after.measured_at - before.measured_at);
}

/// Central difference in the body frame of `here`.
Eigen::Vector3d twist_between(const CalibrationScan& before, const CalibrationScan& here,
                              const CalibrationScan& after) {
  return (between(here.T_odom_body, after.T_odom_body).vector() -
          between(here.T_odom_body, before.T_odom_body).vector()) /
         seconds_between(before, after);
}

/// The motion by a constant twist; the arc's chord, to second order.
Pose2 moved(const Eigen::Vector3d& twist, double seconds) {
  const double half_turn_rad = 0.5 * twist(2) * seconds;
  const Point2 chord = Pose2(0.0, 0.0, half_turn_rad) * Point2{twist(0) * seconds, twist(1) * seconds};
  return {chord.x_m, chord.y_m, 2.0 * half_turn_rad};
}

}  // namespace

double usual_interval_s(std::span<const CalibrationScan> scans) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < scans.size(); ++i) intervals.push_back(seconds_between(scans[i - 1], scans[i]));
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

SystematicMotion::SystematicMotion(std::span<const CalibrationScan> scans,
                                   const SystematicMotionTuning& tuning)
    : scans_(scans), twists_(scans.size(), Eigen::Vector3d::Zero()) {
  const double usual_s = usual_interval_s(scans);
  const auto is_usual = [&](std::size_t i) {
    const double interval_s = seconds_between(scans[i - 1], scans[i]);
    return !scans[i].starts_segment && interval_s > tuning.min_share * usual_s &&
           interval_s < tuning.max_share * usual_s;
  };
  for (std::size_t i = 1; i + 1 < scans.size(); ++i) {
    if (is_usual(i) && is_usual(i + 1)) twists_[i] = twist_between(scans[i - 1], scans[i], scans[i + 1]);
  }
}

Pose2 SystematicMotion::measured(std::size_t i) const {
  return between(scans_[i - 1].T_odom_body, scans_[i].T_odom_body);
}

Pose2 SystematicMotion::predicted(std::size_t i, const Pose2& T_previous_this,
                                  const SystematicErrors& errors) const {
  if (measured(i).vector().isZero(0.0)) return T_previous_this;  // as in OdometryCalibration
  const auto error = [&](SystematicError which) { return errors(index_of(which)); };
  const double age_s = error(SystematicError::kRangeAge);
  const Pose2 T_moved = moved(twists_[i - 1], age_s).inverse() * T_previous_this * moved(twists_[i], age_s);
  const double forward_m = T_moved.x_m() / (1.0 + error(SystematicError::kForwardScale));
  const double left_m = T_moved.y_m() / (1.0 + error(SystematicError::kSidewaysScale));
  const double elapsed_s = seconds_between(scans_[i - 1], scans_[i]);
  const double missed_rad =
      error(SystematicError::kYawPerMetre) * forward_m + error(SystematicError::kYawPerSecond) * elapsed_s;
  const double turn_rad = (T_moved.yaw_rad() - missed_rad) / (1.0 + error(SystematicError::kYawPerRadian));
  return {forward_m, left_m, turn_rad};
}

}  // namespace swiftlet
