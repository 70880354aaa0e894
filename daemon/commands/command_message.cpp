// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_message.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "daemon/publish/decoded_message.hpp"
#include "swiftlet/command_t.hpp"

namespace swiftlet {

/// The length of the name.
template <>
bool can_hold_its_counts<command_t>(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kNameAt = 9;
  return ClaimedCounts(bytes, kNameAt).next().has_value();
}

namespace {

Error unusable(const std::string& why) { return {ErrorCode::kInvalidInput, why}; }

/// Not in the name of a place, which stands in a table.
bool is_forbidden(char letter) {
  const auto byte = static_cast<unsigned char>(letter);
  return byte < 0x20 || byte == 0x7F || letter == ',' || letter == '"';
}

Result<Command> mark_place(const std::string& name) {
  Command command{.kind = Command::Kind::kMarkPlace, .name = {}};
  if (name.empty() || name.size() > command.name.capacity() ||
      std::any_of(name.begin(), name.end(), is_forbidden))
    return unusable("a place's name has 1 to 60 bytes, none of them a control character, comma or quote");
  for (const char letter : name) static_cast<void>(command.name.try_push_back(letter));
  return command;
}

}  // namespace

Result<Command> read_command(std::span<const std::uint8_t> message) {
  const std::optional<command_t> read = decoded_message<command_t>(message);
  if (!read) return unusable("it is no command_t of this version");
  switch (read->action) {
    case command_t::ACTION_SAVE_MAP:
      return Command{.kind = Command::Kind::kSaveMap, .name = {}};
    case command_t::ACTION_MARK_PLACE:
      return mark_place(read->name);
    case command_t::ACTION_NEW_MAP:
      return Command{.kind = Command::Kind::kNewMap, .name = {}};
    default:
      return unusable("there is no action " + std::to_string(read->action));
  }
}

}  // namespace swiftlet
