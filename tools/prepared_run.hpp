// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/base/result.hpp"
#include "core/calibration/systematic_prior.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/workers/pipeline.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "tools/map_command.hpp"

namespace swiftlet {

/// What maps an input: its configuration, calibrated where the command wants it, and its samples.
struct PreparedRun {
  Configuration config;
  std::unique_ptr<SampleSource> source;
  std::optional<InputCalibration> calibration;
};

/// Errors: kNotFound, kInvalidInput: input or configuration cannot be used; the input is a live vehicle.
[[nodiscard]] Result<PreparedRun> prepare_run(const MapCommand& command);
/// The input of a prepared run once more, from its beginning. Errors: as above.
[[nodiscard]] Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command,
                                                               const Configuration& config);
/// kInvalidInput where the run had no sample; `report` has the reason.
[[nodiscard]] Status check_usable(const MapCommand& command, const InputReport& report,
                                  const Backend& backend);

/// All of the input through the pipeline, with progress on stderr; `after_sample`, where it is set, is called
/// after each. The report, with what ended the input before its time among the problems.
[[nodiscard]] InputReport run_to_end(Pipeline& pipeline, const SampleSource& source,
                                     const std::function<void()>& after_sample);
/// All that was wrong with the input, in one line: kDamaged.
[[nodiscard]] Status damage_of(const InputReport& report);

}  // namespace swiftlet
