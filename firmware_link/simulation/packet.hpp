// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/base/check.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// A CRTP packet: header byte and up to 30 data bytes.
using PacketBytes = CrtpPacket;

// Building packets. Precondition of each: there is room.

inline void put(PacketBytes& packet, std::uint8_t byte) {
  SWIFTLET_CHECK(packet.try_push_back(byte), "a packet has 31 bytes");
}
inline void put_bytes(PacketBytes& packet, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) put(packet, byte);
}
inline void put_little_endian(PacketBytes& packet, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) put(packet, static_cast<std::uint8_t>(value >> (8U * i)));
}
inline void put_characters(PacketBytes& packet, std::string_view text) {
  for (const char c : text) put(packet, static_cast<std::uint8_t>(c));
}
/// With the terminating zero.
inline void put_text(PacketBytes& packet, std::string_view text) {
  put_characters(packet, text);
  put(packet, 0);
}
/// The first `bytes` of a packet: the firmware answers many requests in their own buffer.
inline PacketBytes head_of(std::span<const std::uint8_t> packet, std::size_t bytes) {
  PacketBytes head;
  put_bytes(head, packet.first(bytes));
  return head;
}

}  // namespace swiftlet
