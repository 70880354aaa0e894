// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// What `swiftlet map` was asked to do.
struct MapCommand {
  std::string input;                            ///< URI or plain path, see open_sample_source
  std::optional<std::string> output_directory;  ///< unset: a new folder in kFlightsDirectory
  std::string config_file;                      ///< empty: the defaults
  std::string settings;                         ///< TOML, above those of the file
  std::optional<int> beams;                     ///< laser logs: how many beams to keep
  bool calibrate = true;       ///< estimate age of the ranges and scales of the odometry first
  bool odometry_only = false;  ///< baseline: dead reckoning, nothing corrected
  bool frontend_only = false;  ///< baseline: walls, but no loop closures
  bool plan = false;           ///< also a picture of the walls alone
};

/// Takes the whole input through the pipeline at full speed in this thread and writes the outputs. A summary
/// goes to stdout; progress and what was wrong with the input, one line each, to stderr.
///
/// Errors: kDamaged: the input is damaged after usable samples; the outputs are written from what came
/// before, and report.json names the damage too. kNotFound, kInvalidInput: input, configuration or output
/// directory cannot be used, or the input holds no usable sample; nothing was written. kOutOfSpace: an output
/// could not be written; those before it stay. kTimeout: a signal came before the outputs were begun; nothing
/// was written, and no folder stays that was made for them.
[[nodiscard]] Status run_map_command(const MapCommand& command);

}  // namespace swiftlet
