// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/tell_command.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "daemon/commands/command_message.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "firmware_link/link/uri_text.hpp"
#include "swiftlet/command_t.hpp"

namespace swiftlet {
namespace {

std::int8_t action_of(const std::string& what) {
  if (what == "mark-place") return command_t::ACTION_MARK_PLACE;
  return what == "new-map" ? command_t::ACTION_NEW_MAP : command_t::ACTION_SAVE_MAP;
}

Error refused(const std::string& why) { return {ErrorCode::kInvalidInput, why}; }

/// `HOST:PORT`. LCM takes its own port for one that is missing, which is not that of swiftletd.
bool is_address(const std::string& to) {
  const std::size_t colon = std::min(to.find(':'), to.size());
  const std::string host = to.substr(0, colon);
  const auto may_stand_in_host = [](char c) {
    return is_digit(c) || is_letter(c) || c == '.' || c == '-' || c == '_';
  };
  return !host.empty() && std::ranges::all_of(host, may_stand_in_host) && colon < to.size() &&
         whole_number(std::string_view(to).substr(colon + 1), 1, 65535).has_value();
}

}  // namespace

Status run_tell_command(const TellCommand& command) {
  command_t message;
  message.action = action_of(command.what);
  message.name = command.name;
  if (message.action != command_t::ACTION_MARK_PLACE && !command.name.empty())
    return refused("tell " + command.what + ": takes no name");
  if (!is_address(command.to))
    return refused("--to '" + command.to + "': must be ADDRESS:PORT; the default is " +
                   on_this_machine(kCommandsPort));
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  // As swiftletd will read it: a name that it would refuse is refused here.
  if (const Result<Command> read = read_command(bytes); !read)
    return refused("tell: " + read.error().message);
  const Result<std::unique_ptr<LcmTransport>> lcm = LcmTransport::open("tcpq://" + command.to);
  if (!lcm) return lcm.error();
  if (!(*lcm)->publish(command.channel_prefix + "COMMAND", bytes))
    return refused("nobody takes commands on " + command.to + "; start swiftletd with --commands");
  std::printf("sent to %s; the log of swiftletd says what became of it\n", command.to.c_str());
  return {};
}

}  // namespace swiftlet
