// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/input_calibration.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <vector>

#include "core/calibration/stretch_estimate.hpp"

namespace swiftlet {

Result<InputCalibration> calibrate_by_itself(SampleSource& source, const SensorModel& expected,
                                             const std::stop_token& stop) {
  std::vector<RangeSample> samples;
  for (;;) {
    if (stop.stop_requested()) return Error{ErrorCode::kTimeout, "calibration was stopped before its end"};
    const Result<ReceivedSample> received = source.next();
    if (received) samples.push_back(received->sample);
    if (!received && received.error().code != ErrorCode::kTimeout)
      break;  // damage is reported when it is mapped
  }
  if (samples.size() < 2) return Error{ErrorCode::kInvalidInput, "too few samples"};
  const Result<JointEstimate> estimate = estimate_from_stretches(samples, expected, source.beams());
  if (!estimate) return estimate.error();
  SystematicPrior prior = systematic_prior(expected.odometry);
  if (!source.report().shows_age) prior.range_age_s = 0.0;
  return calibrated_by(weighed(*estimate, expected, prior), expected);
}

namespace {

/// Standard deviation of what the input shows, to that of what was expected.
constexpr double kShowsNothing = 0.9;

bool shows(const InputCalibration& calibration, SystematicError error) {
  const OdometryNoise& noise = calibration.expected.odometry;
  const SystematicCovariance prior = covariance_of(systematic_prior(noise), yaw_goes_with_travel(noise));
  const Eigen::Index k = index_of(error);
  return calibration.sigma(k) > 0.0 && calibration.sigma(k) < kShowsNothing * std::sqrt(prior(k, k));
}

}  // namespace

std::optional<std::string> calibration_note(const InputCalibration& calibration, const SensorModel& used) {
  constexpr double kAlike = 1e-6;
  std::string note = "by the input itself: ";
  const auto add = [&](SystematicError error, const char* name, const char* unit) {
    if (!shows(calibration, error)) return;
    if (!note.ends_with(": ")) note += ", ";
    const double value = value_in(calibration.found, error);
    const double kept = value_in(used, error);
    note += fmt::format("{} {:.3f} +- {:.3f}{} ", name, value, calibration.sigma(index_of(error)), unit);
    note += std::abs(kept - value) < kAlike
                ? fmt::format("({:.3f} expected)", value_in(calibration.expected, error))
                : fmt::format("({:.3f} set, kept)", kept);
  };
  add(SystematicError::kRangeAge, "age of the ranges", " s");
  add(SystematicError::kForwardScale, "scale of the odometry", "");
  add(SystematicError::kSidewaysScale, "sideways", "");
  add(SystematicError::kYawPerMetre, "missed yaw", " rad/m");
  if (note.ends_with(": ")) return std::nullopt;
  return note;
}

}  // namespace swiftlet
