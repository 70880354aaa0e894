// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/base/result.hpp"
#include "core/calibration/systematic_prior.hpp"
#include "daemon/config/configuration.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "tools/map_command.hpp"

namespace swiftlet {

/// Where the odometry reports reverse driving as forward.
enum class LostSigns : std::uint8_t {
  kAsReported,      ///< left alone
  kMendedIfSure,    ///< mended where the ranges leave no doubt
  kMendedIfLikely,  ///< mended where they show it once
};

/// What maps an input: its configuration, calibrated where the command wants it, and its samples.
struct PreparedRun {
  Configuration config;
  std::unique_ptr<SampleSource> source;
  std::optional<InputCalibration> calibration;
  LostSigns signs = LostSigns::kMendedIfSure;
  std::vector<std::string> notes;  ///< for the report of the run
};

/// Where the input was read first, for its calibration, and lost signs are likely, it is mapped with them
/// mended and as reported, and prepared in the way that explains the ranges better.
///
/// Errors: kNotFound, kInvalidInput: input or configuration cannot be used; the input is a live vehicle;
/// kTimeout: `stop` was requested, which is looked at while the input is read.
[[nodiscard]] Result<PreparedRun> prepare_run(const MapCommand& command, const std::stop_token& stop = {});
/// The input of a prepared run once more, from its beginning. Errors: as above.
[[nodiscard]] Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command,
                                                               const PreparedRun& run);
/// kInvalidInput where the run had no sample; `report` has the reason.
[[nodiscard]] Status check_usable(const MapCommand& command, const InputReport& report,
                                  const Backend& backend);

/// What its input says at the end, with the notes of the run; what ended it early is damage, too.
[[nodiscard]] InputReport report_of(const PreparedRun& run, const Status& ended);

/// What a run that was stopped returns: kTimeout.
[[nodiscard]] Error stopped_error(const std::string& input);

}  // namespace swiftlet
