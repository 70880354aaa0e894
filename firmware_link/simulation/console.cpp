// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/console.hpp"

#include <string>

namespace swiftlet {
namespace {

constexpr std::uint8_t kConsoleHeader = 0x00;
constexpr std::size_t kFragment = 30;

}  // namespace

void SimulatedConsole::print(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  for (std::size_t at = 0; at < text.size() && queue_.size() < kQueueLimit; at += kFragment) {
    PacketBytes packet;
    put(packet, kConsoleHeader);
    put_characters(packet, std::string_view(text).substr(at, kFragment));
    queue_.push_back(packet);
  }
}

std::optional<PacketBytes> SimulatedConsole::next() {
  if (queue_.empty()) return std::nullopt;
  const PacketBytes packet = queue_.front();
  queue_.pop_front();
  return packet;
}

}  // namespace swiftlet
