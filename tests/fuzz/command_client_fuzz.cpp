// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes as what a program sends to swiftletd --commands, in pieces. Byte 0: the size of a piece.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/base/check.hpp"
#include "daemon/commands/command_message.hpp"
#include "daemon/commands/tcpq_conversation.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  TcpqConversation conversation([](std::string_view, std::span<const std::uint8_t> message) {
    const Result<Command> command = read_command(message);
    const bool has_name = command && !command->name.empty();
    SWIFTLET_CHECK(!has_name || command->kind == Command::Kind::kMarkPlace, "places have names, alone");
  });
  const std::size_t piece = std::max<std::size_t>(1, data[0]);
  for (std::span<const std::uint8_t> rest(data + 1, size - 1); !rest.empty();) {
    const auto next = rest.first(std::min(piece, rest.size()));
    if (!conversation.receive(next)) return 0;
    static_cast<void>(conversation.take_answer());
    rest = rest.subspan(next.size());
  }
  return 0;
}
