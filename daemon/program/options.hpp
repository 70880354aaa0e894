// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "daemon/manual/page_option.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "daemon/recording/recording_plan.hpp"

namespace swiftlet {

/// What swiftletd's command line asks for.
struct Options {
  std::string config_path;
  std::string input_uri;
  std::string lcm_url = kDefaultLcmUrl;
  std::string compat;
  double rate = 1.0;
  std::optional<int> beams;
  std::optional<std::string> output_directory;
  bool no_output = false;
  std::string log_file;
  RecordingWish record;
  std::optional<std::string> share;
  std::optional<std::string> view;
  std::optional<std::string> commands;
  bool print_reference = false;
  bool print_tuning = false;
  bool verbose = false;
};

/// Declares the options of `app`, which fills `options` when it parses.
void declare_options(CLI::App& app, Options& options);
/// What the parser does not: the addresses of options that were given without one, and whether recording was
/// asked for.
void complete_options(const CLI::App& app, Options& options);

/// What the manual page has beyond --help.
[[nodiscard]] ManualFacts manual_facts();

/// Whether INPUT is a recording that is still written.
[[nodiscard]] bool is_followed(const Options& options);

/// An option that takes a word may have taken INPUT for it.
[[nodiscard]] std::string why_no_input(const Options& options);

/// Of a later run: it writes beside the runs before it, with the first number from `number` on that is free,
/// which `number` then is.
[[nodiscard]] Options options_of_run(const Options& options, int& number);

/// One line on stderr; the exit code of bad input.
int refuse(const std::string& why);

}  // namespace swiftlet
