// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/tell_command.hpp"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "daemon/commands/command_message.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "swiftlet/command_t.hpp"

namespace swiftlet {
namespace {

std::int8_t action_of(const std::string& what) {
  if (what == "mark-place") return command_t::ACTION_MARK_PLACE;
  return what == "new-map" ? command_t::ACTION_NEW_MAP : command_t::ACTION_SAVE_MAP;
}

Error refused(const std::string& why) { return {ErrorCode::kInvalidInput, why}; }

}  // namespace

Status run_tell_command(const TellCommand& command) {
  command_t message;
  message.action = action_of(command.what);
  message.name = command.name;
  if (message.action != command_t::ACTION_MARK_PLACE && !command.name.empty())
    return refused("tell " + command.what + ": takes no name");
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
