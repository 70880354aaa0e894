// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/systematic_motion.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "core/sensing/odometry_calibration.hpp"

namespace swiftlet {
namespace {

double seconds_between(const TimedOdometry& before, const TimedOdometry& after) {
  return to_seconds(after.measured_at - before.measured_at);
}

/// Central difference in the body frame of `here`.
Eigen::Vector3d twist_between(const TimedOdometry& before, const TimedOdometry& here,
                              const TimedOdometry& after) {
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

const char* setting_of(SystematicError error) {
  static constexpr std::array<const char*, kSystematicErrors> kSettings{"range_age_s",
                                                                        "odometry_forward_scale",
                                                                        "odometry_sideways_scale",
                                                                        "missed_yaw_per_metre_rad",
                                                                        "missed_yaw_per_radian",
                                                                        "missed_yaw_per_second_rad"};
  return kSettings[static_cast<std::size_t>(error)];
}

double value_in(const SensorModel& sensor, SystematicError error) {
  const OdometryCalibration& calibration = sensor.odometry_calibration;
  switch (error) {
    case SystematicError::kRangeAge:
      return to_seconds(sensor.range_age);
    case SystematicError::kForwardScale:
      return calibration.forward_scale;
    case SystematicError::kSidewaysScale:
      return calibration.sideways_scale;
    case SystematicError::kYawPerMetre:
      return calibration.yaw_per_metre_rad + sensor.odometry.expected_drift_yaw_per_metre_rad;
    case SystematicError::kYawPerRadian:
      return calibration.yaw_per_radian + sensor.odometry.expected_drift_yaw_per_radian;
    case SystematicError::kYawPerSecond:
      return calibration.yaw_per_second_rad;
  }
  return 0.0;
}

double usual_interval_s(std::span<const TimedOdometry> scans) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < scans.size(); ++i) intervals.push_back(seconds_between(scans[i - 1], scans[i]));
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

SystematicMotion::SystematicMotion(std::vector<TimedOdometry> scans, const SystematicMotionTuning& tuning)
    : scans_(std::move(scans)),
      is_usual_(scans_.size(), false),
      has_twist_(scans_.size(), false),
      twists_(scans_.size(), Eigen::Vector3d::Zero()),
      corrected_(scans_.size()) {
  const double usual_s = usual_interval_s(scans_);
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    const double interval_s = seconds_between(scans_[i - 1], scans_[i]);
    is_usual_[i] = !scans_[i].starts_segment && interval_s > tuning.min_share * usual_s &&
                   interval_s < tuning.max_share * usual_s;
  }
  for (std::size_t i = 1; i + 1 < scans_.size(); ++i) has_twist_[i] = is_usual_[i] && is_usual_[i + 1];
  for (std::size_t i = 1; i + 1 < scans_.size(); ++i)
    if (has_twist_[i]) twists_[i] = twist_between(scans_[i - 1], scans_[i], scans_[i + 1]);
}

bool SystematicMotion::shows_time_offset() const {
  return 2 * static_cast<std::size_t>(std::count(has_twist_.begin(), has_twist_.end(), true)) >
         has_twist_.size();
}

Pose2 SystematicMotion::measured(std::size_t i) const {
  return between(scans_[i - 1].T_odom_body, scans_[i].T_odom_body);
}

SystematicMotion::Earlier SystematicMotion::earlier(std::size_t i, double seconds) const {
  if (!has_twist_[i]) return {scans_[i].T_odom_body, Eigen::Vector3d::Zero()};
  std::size_t low = i;  // the time lies between this scan and the next, or at it
  double after_low_s = -seconds;
  while (after_low_s < 0.0 && low > 0 && is_usual_[low]) {
    after_low_s += seconds_between(scans_[low - 1], scans_[low]);
    --low;
  }
  while (low + 1 < scans_.size() && is_usual_[low + 1] &&
         after_low_s >= seconds_between(scans_[low], scans_[low + 1])) {
    after_low_s -= seconds_between(scans_[low], scans_[low + 1]);
    ++low;
  }
  Pose2 T_odom_body = scans_[i].T_odom_body;
  Eigen::Vector3d twist = twists_[i];
  if (after_low_s >= 0.0 && low + 1 < scans_.size() && is_usual_[low + 1]) {
    const double share = after_low_s / seconds_between(scans_[low], scans_[low + 1]);
    const Eigen::Vector3d step = measured(low + 1).vector();
    T_odom_body = scans_[low].T_odom_body * Pose2(share * step(0), share * step(1), share * step(2));
    twist = (1.0 - share) * twists_[low] + share * twists_[low + 1];
  } else {
    T_odom_body = T_odom_body * moved(twist, -seconds);
  }
  return {T_odom_body, jacobian_compose_second(T_odom_body) * twist};
}

CorrectedStep SystematicMotion::corrected(std::size_t i, const Earlier& before, const Earlier& here,
                                          const SystematicErrors& errors) const {
  const Pose2 T_before_odom = before.T_odom_body.inverse();
  const Pose2 step = T_before_odom * here.T_odom_body;
  CorrectedStep corrected{step, decltype(CorrectedStep::by_errors)::Zero()};
  if (step.vector().isZero(0.0)) return corrected;  // as in OdometryCalibration
  const double elapsed_s = seconds_between(scans_[i - 1], scans_[i]);
  const auto error = [&](SystematicError which) { return errors(index_of(which)); };
  const OdometryCalibration calibration{
      1.0 + error(SystematicError::kForwardScale), 1.0 + error(SystematicError::kSidewaysScale),
      error(SystematicError::kYawPerMetre), error(SystematicError::kYawPerRadian),
      error(SystematicError::kYawPerSecond)};
  corrected.T_previous_this = calibration.corrected(step, from_seconds(elapsed_s));
  Eigen::Matrix3d by_step = Eigen::Matrix3d::Zero();
  by_step.diagonal() << calibration.forward_scale, calibration.sideways_scale,
      1.0 + calibration.yaw_per_radian;
  by_step(2, 0) = calibration.yaw_per_metre_rad;
  const Eigen::Vector3d step_by_time = jacobian_compose_first(T_before_odom, here.T_odom_body) *
                                           (jacobian_inverse(before.T_odom_body) * before.by_time) +
                                       jacobian_compose_second(T_before_odom) * here.by_time;
  const auto by = [&](SystematicError which) { return corrected.by_errors.col(index_of(which)); };
  by(SystematicError::kRangeAge) = -by_step * step_by_time;
  by(SystematicError::kForwardScale)(0) = step.x_m();
  by(SystematicError::kSidewaysScale)(1) = step.y_m();
  by(SystematicError::kYawPerMetre)(2) = step.x_m();
  by(SystematicError::kYawPerRadian)(2) = step.yaw_rad();
  by(SystematicError::kYawPerSecond)(2) = elapsed_s;
  return corrected;
}

std::span<const CorrectedStep> SystematicMotion::correct(const SystematicErrors& errors) {
  const double age_s = errors(index_of(SystematicError::kRangeAge));
  if (scans_.empty()) return corrected_;
  Earlier before = earlier(0, age_s);
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    const Earlier here = earlier(i, age_s);
    corrected_[i] = corrected(i, before, here, errors);
    before = here;
  }
  return corrected_;
}

}  // namespace swiftlet
