// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>

#include "core/base/check.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Packets in the order in which they came, in fixed storage. `Packet` may say more of one than its bytes.
template <std::size_t kCapacity, typename Packet = CrtpPacket>
class PacketRing {
 public:
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// False, and nothing changed, when full.
  [[nodiscard]] bool try_push(const Packet& packet) {
    if (size_ == kCapacity) return false;
    packets_[(first_ + size_) % kCapacity] = packet;
    ++size_;
    return true;
  }
  /// The oldest. Precondition: not empty().
  [[nodiscard]] const Packet& front() const { return (*this)[0]; }
  /// Oldest first. Precondition: i < size().
  [[nodiscard]] const Packet& operator[](std::size_t i) const {
    SWIFTLET_CHECK(i < size_, "there is a packet");
    return packets_[(first_ + i) % kCapacity];
  }
  /// Removes the oldest. Precondition: not empty().
  void pop() {
    SWIFTLET_CHECK(size_ > 0, "there is a packet");
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

 private:
  std::array<Packet, kCapacity> packets_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace swiftlet
