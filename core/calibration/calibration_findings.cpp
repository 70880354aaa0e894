// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/calibration_findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace swiftlet {
namespace {

using Verdict = CalibrationFinding::Verdict;

/// The properties of a systematic error.
struct Kind {
  const char* meaning;
  const char* unit;
  double offset;  // of the setting from the error
};
constexpr std::array<Kind, kSystematicErrors> kKinds{{
    {"age of the ranges", "s", 0.0},
    {"metres moved per metre measured, forward", "", 1.0},
    {"the same, sideways", "", 1.0},
    {"yaw missed per metre forward", "rad/m", 0.0},
    {"share of each turn missed", "", 0.0},
    {"yaw missed per second", "rad/s", 0.0},
}};

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

CalibrationFinding blank_finding(SystematicError error, const SensorModel& sensor) {
  const Kind& kind = kKinds[static_cast<std::size_t>(error)];
  CalibrationFinding finding;
  finding.setting = setting_of(error);
  finding.meaning = kind.meaning;
  finding.unit = kind.unit;
  finding.present = value_in(sensor, error);
  return finding;
}

std::string too_short(const char* what, double has_m, double min_m) {
  return number("only %.1f m of travel ", has_m) + what + number(", %.0f m are needed", min_m);
}
std::string too_few_turns(double turned_rad, double min_rad) {
  return number("only %.1f turns of 360 degrees in all", turned_rad / (2.0 * kPi)) +
         number(", %.0f are needed", min_rad / (2.0 * kPi));
}

/// What the motion lacks for estimating an error; empty where it lacks nothing.
std::string what_lacks(SystematicError error, const MotionSummary& motion, const SensorModel& sensor,
                       const CalibrationFindingsTuning& tuning) {
  const bool has_wheels = yaw_goes_with_travel(sensor.odometry);
  switch (error) {
    case SystematicError::kRangeAge:
    case SystematicError::kYawPerRadian:
      return motion.turned_rad < tuning.min_turns_rad ? too_few_turns(motion.turned_rad, tuning.min_turns_rad)
                                                      : "";
    case SystematicError::kForwardScale:
      return motion.forward_m < tuning.min_path_m ? too_short("forward", motion.forward_m, tuning.min_path_m)
                                                  : "";
    case SystematicError::kSidewaysScale:
      if (has_wheels) return "wheels do not move sideways";
      return motion.sideways_m < tuning.min_path_m
                 ? too_short("sideways", motion.sideways_m, tuning.min_path_m)
                 : "";
    case SystematicError::kYawPerMetre:
      if (!has_wheels) return "the yaw comes from a gyro, whose error does not go with travel";
      return motion.forward_m < tuning.min_path_m ? too_short("forward", motion.forward_m, tuning.min_path_m)
                                                  : "";
    case SystematicError::kYawPerSecond:
      if (has_wheels) return "the yaw comes from wheels, whose error does not go with time";
      if (motion.duration_s < tuning.min_duration_s)
        return number("only %.0f s long", motion.duration_s) +
               number(", %.0f s are needed", tuning.min_duration_s);
      return "";
  }
  return "";
}

bool is_learnt(SystematicError error, const OdometryNoise& noise) {
  return (error == SystematicError::kYawPerMetre && noise.drift_yaw_per_metre_rad > 0.0) ||
         (error == SystematicError::kYawPerRadian && noise.drift_yaw_per_radian > 0.0);
}

Verdict verdict_of(SystematicError error, const CalibrationFinding& finding, const SensorModel& sensor,
                   const CalibrationFindingsTuning& tuning) {
  const double difference = std::abs(finding.value - finding.present);
  if (difference < tuning.significant_sigmas * finding.sigma) return Verdict::kAsIs;
  if (difference < tuning.negligible[static_cast<std::size_t>(error)]) return Verdict::kNegligible;
  return is_learnt(error, sensor.odometry) ? Verdict::kLearnt : Verdict::kMatters;
}

CalibrationFinding judged(SystematicError error, const JointEstimate& estimate, const MotionSummary& motion,
                          const SensorModel& sensor, const CalibrationFindingsTuning& tuning) {
  const Kind& kind = kKinds[static_cast<std::size_t>(error)];
  CalibrationFinding finding = blank_finding(error, sensor);
  finding.reason = what_lacks(error, motion, sensor, tuning);
  if (!finding.reason.empty()) return finding;
  finding.value = kind.offset + estimate.errors(index_of(error));
  if (error == SystematicError::kRangeAge)
    finding.value = to_seconds(
        within_limits_of_range_age(sensor.range_age + from_seconds(estimate.errors(index_of(error)))));
  finding.sigma = estimate.sigma(index_of(error));
  const double max_sigma = tuning.max_sigma[static_cast<std::size_t>(error)];
  if (!(finding.sigma <= max_sigma)) {
    finding.reason = number("known to +- %.2g", finding.sigma) + number(" only, %.2g", max_sigma) +
                     " would be significant; more such motion near walls helps";
    return finding;
  }
  finding.verdict = verdict_of(error, finding, sensor, tuning);
  return finding;
}

}  // namespace

std::optional<std::string> why_hopeless(const MotionSummary& motion,
                                        const CalibrationFindingsTuning& tuning) {
  if (std::max(motion.forward_m, motion.sideways_m) >= tuning.min_path_m ||
      motion.turned_rad >= tuning.min_turns_rad)
    return std::nullopt;
  return number("the vehicle moved only %.1f m", motion.forward_m + motion.sideways_m) +
         number(" and turned only %.0f degrees in all", degrees(motion.turned_rad));
}

CalibrationFindings judge_estimate(const JointEstimate& estimate, const MotionSummary& motion,
                                   const SensorModel& sensor, const CalibrationFindingsTuning& tuning) {
  if (estimate.returns_on_them < tuning.min_returns)
    return nothing_observable("only " + std::to_string(estimate.returns_on_them) +
                                  " returns lie on walls that were seen often, " +
                                  std::to_string(tuning.min_returns) + " are needed",
                              sensor);
  CalibrationFindings findings;
  for (std::size_t i = 0; i < findings.size(); ++i)
    findings[i] = judged(static_cast<SystematicError>(i), estimate, motion, sensor, tuning);
  return findings;
}

CalibrationFindings nothing_observable(const std::string& reason, const SensorModel& sensor) {
  CalibrationFindings findings;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    findings[i] = blank_finding(static_cast<SystematicError>(i), sensor);
    findings[i].reason = reason;
  }
  return findings;
}

SensorModel calibrated(const CalibrationFindings& findings, SensorModel sensor) {
  const auto set = [&](SystematicError error, double& place) {
    const CalibrationFinding& finding = findings[static_cast<std::size_t>(error)];
    if (finding.verdict == Verdict::kMatters) place = finding.value;
  };
  double range_age_s = to_seconds(sensor.range_age);
  set(SystematicError::kRangeAge, range_age_s);
  sensor.range_age = from_seconds(range_age_s);
  OdometryCalibration& calibration = sensor.odometry_calibration;
  set(SystematicError::kForwardScale, calibration.forward_scale);
  set(SystematicError::kSidewaysScale, calibration.sideways_scale);
  set(SystematicError::kYawPerMetre, calibration.yaw_per_metre_rad);
  set(SystematicError::kYawPerRadian, calibration.yaw_per_radian);
  set(SystematicError::kYawPerSecond, calibration.yaw_per_second_rad);
  return sensor;
}

}  // namespace swiftlet
