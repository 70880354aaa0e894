// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "daemon/publish/lcm_transport.hpp"

namespace swiftlet {

inline constexpr const char* kLcmInput = "lcm:";

/// What `swiftlet convert` was asked to do.
struct ConvertCommand {
  std::string input;         ///< URI or plain path, see open_sample_source; kLcmInput: a running swiftletd
  std::string output;        ///< .csv: samples, .g2o: pose graph, .mcap: messages of Foxglove's kinds
  std::string config_file;   ///< empty: the defaults
  std::optional<int> beams;  ///< laser logs: how many beams to keep
  bool calibrate = true;     ///< as of swiftlet map
  std::string lcm_url = kDefaultLcmUrl;  ///< where swiftletd publishes
  std::string channel_prefix = "SWIFTLET_";
};

/// Writes what the output's name asks for, in this thread; of a running swiftletd until its run has ended.
/// Watches for SIGINT, SIGTERM and SIGHUP, which end it: to be called before any other thread runs. A summary
/// goes to stdout; progress, notes and what was wrong with the input, a line each, to stderr. A file that was
/// there is replaced, with a note, once the new one is complete.
///
/// Errors: kDamaged: the input is damaged after usable samples; the output holds what came before. kNotFound,
/// kInvalidInput: input, configuration or output cannot be used, or the input holds no usable sample; nothing
/// was written. kOutOfSpace: the output could not be written. kTimeout: a signal came before the end of an
/// input that is no running swiftletd; nothing was written.
[[nodiscard]] Status run_convert_command(const ConvertCommand& command);

}  // namespace swiftlet
