// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <optional>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// A request that is repeated every 200 ms, or as given, until it is answered: one outstanding, because older
/// firmware loses replies to bursts.
class PendingRequest {
 public:
  static constexpr Duration kRepeatAfter = std::chrono::milliseconds(200);

  void ask(const CrtpPacket& packet, Duration repeat_after = kRepeatAfter) {
    packet_ = packet;
    repeat_after_ = repeat_after;
    sent_at_.reset();
  }
  void drop() { packet_.reset(); }
  [[nodiscard]] const std::optional<CrtpPacket>& packet() const { return packet_; }
  /// Its next transmission would be a repetition.
  [[nodiscard]] bool was_sent() const { return sent_at_.has_value(); }
  [[nodiscard]] bool is_due(HostTime now) const {
    return packet_ && !(sent_at_ && now - *sent_at_ < repeat_after_);
  }
  /// The packet to send now, if it is due.
  [[nodiscard]] std::optional<CrtpPacket> take_due(HostTime now) {
    if (!is_due(now)) return std::nullopt;
    sent_at_ = now;
    return packet_;
  }

 private:
  std::optional<CrtpPacket> packet_;
  Duration repeat_after_ = kRepeatAfter;
  std::optional<HostTime> sent_at_;
};

}  // namespace swiftlet
