// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/input_calibration.hpp"

#include <spdlog/fmt/fmt.h>

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

std::string calibration_note(const InputCalibration& calibration) {
  std::string note = "by the input itself: ";
  const auto add = [&](SystematicError error, const char* name, const char* unit) {
    const double sigma = calibration.sigma(index_of(error));
    if (sigma == 0.0) return;
    if (!note.ends_with(": ")) note += ", ";
    note += fmt::format("{} {:.3f} +- {:.3f}{} ({:.3f} expected)", name, value_in(calibration.found, error),
                        sigma, unit, value_in(calibration.expected, error));
  };
  add(SystematicError::kRangeAge, "age of the ranges", " s");
  add(SystematicError::kForwardScale, "scale of the odometry", "");
  add(SystematicError::kSidewaysScale, "sideways", "");
  add(SystematicError::kYawPerMetre, "missed yaw", " rad/m");
  return note;
}

}  // namespace swiftlet
