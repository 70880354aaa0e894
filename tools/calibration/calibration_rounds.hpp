// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/go_on.hpp"
#include "core/base/result.hpp"
#include "core/calibration/joint_problem.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"
#include "tools/calibration/calibration_report.hpp"

namespace swiftlet {

/// A whole run in memory, its ranges paired with dead reckoning at the range age of `sensor`.
struct PairedRun {
  std::vector<RangeSample> samples;
  BeamLayout beams;
  SensorModel sensor;
  bool shows_age = true;  ///< false: ranges and dead reckoning have one stamp, see InputReport
};

/// Reads one and the same run from its beginning, its ranges taken for so old; nothing: for as old as they
/// are by its own sensor model.
using ReadRun = std::function<Result<PairedRun>(std::optional<Duration> range_age)>;

/// What `swiftlet calibrate` does with a run: maps and estimates, reads it anew at the range age so found
/// until that settles, and in the end maps it with what matters set. A run that shows no age is estimated
/// once, and the age is not observable. `name`: of the run, for report and messages. For `go_on` all this is
/// one piece of work.
///
/// Errors: those of `read_run`; kInvalidInput: fewer than two samples; kTimeout where `go_on` returned false;
/// kSolver. Allocates. Repeatable.
[[nodiscard]] Result<CalibrationReport> calibrate_in_rounds(const std::string& name, const ReadRun& read_run,
                                                            const GoOn& go_on);

}  // namespace swiftlet
