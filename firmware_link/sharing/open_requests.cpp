// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/open_requests.hpp"

#include <algorithm>
#include <array>

#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kWhole = kMaxCrtpPacket;

/// How many bytes of a request its answer begins with; 0: it has no answer of its own.
std::size_t repeated_bytes(std::span<const std::uint8_t> packet) {
  struct Row {
    CrtpTopic topic;
    std::size_t bytes;
  };
  constexpr std::array<Row, 4> kRows{
      {{kLinkEchoTopic, kWhole}, {kLinkSourceTopic, 1}, {kPlatformVersionTopic, 2}, {kParamReadTopic, 3}}};
  for (const Row& row : kRows)
    if (is_on(packet, row.topic)) return row.bytes;
  if (!is_on(packet, kLogTocTopic) && !is_on(packet, kParamTocTopic)) return 0;
  const bool is_item = packet.size() > 1 && packet[1] == static_cast<std::uint8_t>(TocCommand::kItem);
  return is_item ? 4 : 2;  // with the item's number
}

}  // namespace

bool is_missing_item(std::span<const std::uint8_t> answer) {
  return answer.size() == 2 && answer[1] == static_cast<std::uint8_t>(TocCommand::kItem) &&
         (is_on(answer, kLogTocTopic) || is_on(answer, kParamTocTopic));
}

bool answers_a_request(std::span<const std::uint8_t> packet) { return repeated_bytes(packet) > 0; }

void OpenRequests::sent(std::span<const std::uint8_t> request) {
  const std::size_t bytes = std::min(repeated_bytes(request), request.size());
  if (bytes == 0) return;
  if (open_.full()) open_.erase_front(1);
  static_cast<void>(open_.try_push_back(packet_of(request.first(bytes))));
}

bool OpenRequests::take_answer(std::span<const std::uint8_t> answer) {
  const std::size_t bytes = std::min(repeated_bytes(answer), answer.size());
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const std::span<const std::uint8_t> asked = bytes_of(open_[i]);
    const std::size_t compared = is_missing_item(answer) ? std::min(asked.size(), bytes) : asked.size();
    if (compared != bytes || !is_same_packet(asked.first(compared), answer.first(compared))) continue;
    open_.erase(i);
    return true;
  }
  return false;
}

}  // namespace swiftlet
