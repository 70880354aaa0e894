// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Measures how long a packet takes to the vehicle and back, once a second, by the firmware's echo service. A
/// lost packet is not repeated. One thread at a time; allocates nothing.
class RoundTrip {
 public:
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now) {
    if (sent_at_ && now - *sent_at_ < kPeriod) return std::nullopt;
    sent_at_ = now;
    ++number_;
    is_open_ = true;
    return make_crtp_packet(kLinkEchoTopic, {'s', 'w', 'l', number_});
  }
  /// Whether an echo is of this program.
  [[nodiscard]] static bool is_own(std::span<const std::uint8_t> echo) {
    return echo.size() == 5 && echo[1] == 's' && echo[2] == 'w' && echo[3] == 'l';
  }
  void on_frame(std::span<const std::uint8_t> packet, HostTime at) {
    if (!is_open_ || !is_on(packet, kLinkEchoTopic) || packet.size() != 5 || packet[4] != number_) return;
    is_open_ = false;
    last_ = at - *sent_at_;
  }
  /// A new connection: the measurement of the last one is discarded.
  void restart() {
    is_open_ = false;
    last_ = Duration::zero();
  }
  /// The last one measured; 0 before the first.
  [[nodiscard]] Duration last() const { return last_; }

 private:
  static constexpr Duration kPeriod = std::chrono::seconds(1);
  std::optional<HostTime> sent_at_;
  std::uint8_t number_ = 0;
  bool is_open_ = false;
  Duration last_{0};
};

}  // namespace swiftlet
