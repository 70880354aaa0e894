// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "core/base/settings.hpp"

namespace swiftlet {

/// For an option that takes a real number: one within these limits; NaN lies within none (CLI::Range takes
/// it).
inline CLI::Validator number_from(double lowest, double highest) {
  const std::string limits = shortest_text(lowest) + " to " + shortest_text(highest);
  const auto problem_with = [lowest, highest, limits](const std::string& text) {
    double number = std::numeric_limits<double>::quiet_NaN();
    const bool is_number = CLI::detail::lexical_cast(text, number);
    if (is_number && number >= lowest && number <= highest) return std::string();
    return text + " is no number from " + limits;
  };
  return {problem_with, "NUMBER from " + limits};
}

/// A limit of the file size (ulimit -f) becomes an error of what writes, instead of the end of the program.
inline void take_file_size_limit_as_error() { static_cast<void>(std::signal(SIGXFSZ, SIG_IGN)); }

/// Whoever reads what the program says may be gone (a pipe to a program that the same Ctrl-C ended): it goes
/// on.
inline void outlive_readers() { static_cast<void>(std::signal(SIGPIPE, SIG_IGN)); }

/// Answers --help or --version; its exit code.
inline int answer(const CLI::App& app, const CLI::Success& question) {
  std::ostringstream text;
  const int exit_code = app.exit(question, text, text);
  std::fputs(text.str().c_str(), stdout);
  return exit_code;
}

/// What keeps stdout from being complete; nullopt when all was written. At the end of a program.
inline std::optional<std::string> output_failure() {
  errno = 0;
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0) return std::nullopt;
  const int reason = errno != 0 ? errno : EIO;
  return "the output is not complete: " + std::generic_category().message(reason);
}

}  // namespace swiftlet
