// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Switches safelink of the vehicle's radio on or off, which keeps it until the next request, whoever sends
/// it. The radio acknowledges with the same three bytes.
constexpr std::array<std::uint8_t, 3> safelink_request(bool on) {
  return {0xFF, 0x05, static_cast<std::uint8_t>(on ? 1 : 0)};
}

/// Whether an acknowledgement's payload confirms safelink_request(on). The link bits are ignored.
constexpr bool is_safelink_echo(std::span<const std::uint8_t> payload, bool on) {
  return payload.size() == 3 && (payload[0] & kTopicBits) == kTopicBits && payload[1] == 0x05 &&
         payload[2] == safelink_request(on)[2];
}

/// The host's side of safelink: with one bit a direction in each header, both sides distinguish a packet from
/// its repetition: none is lost and none counts twice, whichever acknowledgements are lost. Allocates
/// nothing.
class Safelink {
 public:
  enum class Payload { kNone, kNew, kRepeat };

  /// When the vehicle has confirmed safelink: both sides reset their counters.
  constexpr void restart() { up_ = down_ = 0; }
  /// The header with which a packet is sent. The same until acknowledged(): an unacknowledged packet is to be
  /// sent again unchanged.
  [[nodiscard]] constexpr std::uint8_t header(std::uint8_t header) const {
    return static_cast<std::uint8_t>((header & kTopicBits) | (up_ << 3) | (down_ << 2));
  }
  /// The packet was acknowledged with this payload. Returns what the payload is.
  constexpr Payload acknowledged(std::span<const std::uint8_t> payload) {
    up_ ^= 1U;
    if (payload.empty()) return Payload::kNone;
    if (((payload[0] >> 2) & 1U) != down_) return Payload::kRepeat;
    down_ ^= 1U;
    return Payload::kNew;
  }

 private:
  unsigned up_ = 0;    ///< of the packet that is sent next
  unsigned down_ = 0;  ///< of the packet that is expected next
};

}  // namespace swiftlet
