// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/check.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// A packet without content: a poll, or the answer of a vehicle that has nothing to send.
constexpr bool is_null_packet(std::span<const std::uint8_t> packet) {
  return !packet.empty() && (packet[0] & kTopicBits) == kTopicBits;
}

/// Whether it is neither a null packet nor longer than a packet can be.
constexpr bool has_content(std::span<const std::uint8_t> packet) {
  return !packet.empty() && packet.size() <= kMaxCrtpPacket && !is_null_packet(packet);
}

/// Whether both are the same packet, apart from the link bits.
constexpr bool is_same_packet(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return !a.empty() && a.size() == b.size() && ((a[0] ^ b[0]) & kTopicBits) == 0 &&
         std::ranges::equal(a.subspan(1), b.subspan(1));
}

/// Precondition: at most 31 bytes.
constexpr CrtpPacket packet_of(std::span<const std::uint8_t> bytes) {
  SWIFTLET_CHECK(bytes.size() <= kMaxCrtpPacket, "a packet has at most 31 bytes");
  CrtpPacket packet;
  for (const std::uint8_t byte : bytes) static_cast<void>(packet.try_push_back(byte));
  return packet;
}

/// Precondition: at most 31 bytes.
inline LinkFrame frame_of(LinkDirection direction, HostTime at, std::span<const std::uint8_t> packet) {
  LinkFrame frame;
  SWIFTLET_CHECK(packet.size() <= frame.bytes.size(), "a packet has at most 31 bytes");
  frame.at = at;
  frame.direction = direction;
  frame.size = static_cast<std::uint8_t>(packet.size());
  std::ranges::copy(packet, frame.bytes.begin());
  return frame;
}

}  // namespace swiftlet
