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
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {

/// Requests that wait to be sent over a live link. Fixed storage; a request that waits already is not queued
/// twice, and a request without room is dropped: requests without an answer are repeated anyway.
class RequestQueue {
 public:
  /// More than a session has outstanding at a time.
  static constexpr std::size_t kCapacity = 24;

  /// Error: kInvalidInput: not 1 to 31 bytes, or a null packet, which may switch the vehicle off.
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
    static_cast<void>(waiting_.try_push_back(packet_of(packet)));
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
