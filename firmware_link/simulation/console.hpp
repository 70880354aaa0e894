// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <deque>
#include <optional>
#include <string_view>

#include "firmware_link/simulation/packet.hpp"

namespace swiftlet {

/// The console of the vehicle's firmware (CRTP port 0): lines of text, cut into packets as they fill up. One
/// thread at a time; allocates.
class SimulatedConsole {
 public:
  /// Queues a line; the line's end is added. Text without room in the queue is lost.
  void print(std::string_view line);
  /// The next packet to send; nullopt: all was sent.
  [[nodiscard]] std::optional<PacketBytes> next();
  void clear() { queue_.clear(); }

 private:
  static constexpr std::size_t kQueueLimit = 200;  // packets, as the firmware's transmit queue

  std::deque<PacketBytes> queue_;
};

}  // namespace swiftlet
