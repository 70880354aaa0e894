// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "daemon/system/default_addresses.hpp"

namespace swiftlet {

/// The options of `swiftlet tell`.
struct TellCommand {
  std::string what;                                 ///< save-map, mark-place or new-map
  std::string name;                                 ///< of the place
  std::string to = on_this_machine(kCommandsPort);  ///< where swiftletd takes commands
  std::string channel_prefix = "SWIFTLET_";
};

/// Sends a command to a running swiftletd, whose log says what became of it. Errors: kInvalidInput: the name
/// does not fit the command, `to` is no address, or nobody takes commands there.
[[nodiscard]] Status run_tell_command(const TellCommand& command);

}  // namespace swiftlet
