// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "daemon/system/default_addresses.hpp"

namespace swiftlet {

/// The options of `swiftlet view`.
struct ViewCommand {
  std::string input;                                ///< a recording or simulation; empty: a running swiftletd
  std::string listen = on_this_machine(kViewPort);  ///< where browsers find the page
  std::vector<std::string> foreign_origins;         ///< pages of these may look, too
  std::string lcm_url = kDefaultLcmUrl;             ///< where swiftletd publishes
  std::string channel_prefix = "SWIFTLET_";
  double rate = 1.0;         ///< a recording is played at this many times its pace
  std::string config_file;   ///< for a recording; empty: the defaults
  std::optional<int> beams;  ///< laser logs: how many beams to keep
};

/// Serves the live map to browsers until SIGINT, SIGTERM or SIGHUP. A recording is mapped meanwhile, as fast
/// as it can be. Prints the page's address to stdout; what was wrong with a recording goes to stderr. To be
/// called before any other thread runs.
///
/// Errors: kNotFound, kInvalidInput: input, configuration, LCM URL, address or origin cannot be used.
[[nodiscard]] Status run_view_command(const ViewCommand& command);

}  // namespace swiftlet
