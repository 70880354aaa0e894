// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// What `swiftlet calibrate` was asked to do.
struct CalibrateCommand {
  std::string input;                ///< a recording or simulation, see open_sample_source
  std::filesystem::path toml_file;  ///< empty: write none; must not be there yet
  std::optional<int> beams;         ///< laser logs: how many beams to keep
  bool json = false;                ///< for programs, not the table
};

/// Estimates the sensor model's systematic errors from one run and prints them on stdout; what matters goes
/// to the configuration file. Progress and notes go to stderr. SIGINT, SIGTERM and SIGHUP end it between two
/// steps.
///
/// Errors: kNotFound, kInvalidInput: the input cannot be used, or the file is there already or cannot be
/// written, which is asked first. kDamaged: the input is damaged after usable samples; what came before was
/// used. kTimeout: a signal came; nothing was written. kOutOfSpace: the file was not written; what it holds
/// was printed. kSolver.
[[nodiscard]] Status run_calibrate_command(const CalibrateCommand& command);

}  // namespace swiftlet
