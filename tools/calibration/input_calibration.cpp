// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/input_calibration.hpp"

#include <spdlog/fmt/fmt.h>

#include <vector>

#include "core/calibration/stretch_estimate.hpp"

namespace swiftlet {

Result<InputCalibration> calibrate_by_itself(SampleSource& source, const SensorModel& expected) {
  std::vector<RangeSample> samples;
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (received) samples.push_back(received->sample);
    if (!received && received.error().code != ErrorCode::kTimeout)
      break;  // damage is reported when it is mapped
  }
  if (samples.size() < 2) return Error{ErrorCode::kInvalidInput, "too few samples"};
  const Result<JointEstimate> estimate = estimate_from_stretches(samples, expected, source.beams());
  if (!estimate) return estimate.error();
  return calibrated_by(weighed(*estimate, expected), expected);
}

std::string calibration_note(const InputCalibration& calibration) {
  const auto text = [&](SystematicError error, const char* name, const char* unit) {
    const double sigma = calibration.sigma(index_of(error));
    if (sigma == 0.0) return std::string();
    return fmt::format("{} {:.3f} +- {:.3f}{} ({:.3f} expected)", name, value_in(calibration.found, error),
                       sigma, unit, value_in(calibration.expected, error));
  };
  std::string note = "by the input itself: " + text(SystematicError::kRangeAge, "age of the ranges", " s") +
                     ", " + text(SystematicError::kForwardScale, "scale of the odometry", "");
  const std::string sideways = text(SystematicError::kSidewaysScale, "sideways", "");
  return sideways.empty() ? note : note + ", " + sideways;
}

}  // namespace swiftlet
