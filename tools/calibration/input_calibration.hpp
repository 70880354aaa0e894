// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "core/base/result.hpp"
#include "core/calibration/systematic_prior.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Reads a source to its end and estimates what its samples show of its sensors. `expected`: its sensor
/// model, with what a configuration sets. Errors: kInvalidInput: fewer than two samples; kSolver; kTimeout:
/// `stop` was requested, which is looked at before each sample. Allocates. Repeatable.
[[nodiscard]] Result<InputCalibration> calibrate_by_itself(SampleSource& source, const SensorModel& expected,
                                                           const std::stop_token& stop = {});

/// One line on what the input shows of its sensors; nullopt: nothing. Where the sensor model `used` has
/// another value than the one found, a configuration set it.
[[nodiscard]] std::optional<std::string> calibration_note(const InputCalibration& calibration,
                                                          const SensorModel& used);

}  // namespace swiftlet
