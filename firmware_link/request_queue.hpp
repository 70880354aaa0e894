// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "firmware_link/crtp_packet.hpp"

namespace swiftlet {

/// The packet that says nothing: polls, and what a vehicle answers that has nothing to say.
constexpr bool is_null_packet(std::span<const std::uint8_t> packet) {
  return !packet.empty() && (packet[0] & 0xF3) == 0xF3;
}

/// The same packet but for the link bits.
constexpr bool is_same_packet(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return !a.empty() && a.size() == b.size() && ((a[0] ^ b[0]) & 0xF3) == 0 &&
         std::ranges::equal(a.subspan(1), b.subspan(1));
}

/// Requests that wait to be sent over a live link. Fixed storage; a request that waits already is not queued
/// twice, and what it has no room for is dropped: requests without an answer are repeated anyway.
class RequestQueue {
 public:
  static constexpr std::size_t kCapacity = 8;

  /// Error: kInvalidInput: not 1 to 31 bytes, or a null packet: with those, radios are switched, also off.
  Status push(std::span<const std::uint8_t> packet) {
    if (packet.empty() || packet.size() > kMaxCrtpPacket)
      return Error{ErrorCode::kInvalidInput,
                   "a packet of " + std::to_string(packet.size()) + " bytes; CRTP takes 1 to 31"};
    if (is_null_packet(packet))
      return Error{ErrorCode::kInvalidInput, "null packets are the link's own; send requests only"};
    const auto is_packet = [&](const CrtpPacket& waiting) {
      return is_same_packet(bytes_of(waiting), packet);
    };
    if (std::ranges::any_of(waiting_, is_packet)) return {};
    CrtpPacket copy;
    for (const std::uint8_t byte : packet) static_cast<void>(copy.try_push_back(byte));
    static_cast<void>(waiting_.try_push_back(copy));
    return {};
  }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  /// The oldest. Precondition: not empty().
  CrtpPacket pop() {
    const CrtpPacket packet = waiting_.front();
    waiting_.erase_front(1);
    return packet;
  }
  void clear() { waiting_.clear(); }

 private:
  FixedVector<CrtpPacket, kCapacity> waiting_;
};

}  // namespace swiftlet
