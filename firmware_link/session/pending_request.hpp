// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/repeat_timer.hpp"

namespace swiftlet {

/// A request that is repeated until it is answered: after 200 ms, or later where answers take longer. It
/// measures how long they take.
class PendingRequest {
 public:
  /// A repeated command is not without effect; so not as soon as possible.
  static constexpr Duration kShortestWait = std::chrono::milliseconds(200);

  /// `timer`: what is known of the round trip.
  explicit PendingRequest(const RepeatTimer& timer = {}) : timer_(timer) {}

  /// `patience`: how many times as long to wait.
  void ask(const CrtpPacket& packet, int patience = 1) {
    packet_ = packet;
    patience_ = patience;
    sent_at_.reset();
    was_repeated_ = false;
  }
  void drop() { packet_.reset(); }
  [[nodiscard]] const std::optional<CrtpPacket>& packet() const { return packet_; }
  /// Its next transmission would be a repetition.
  [[nodiscard]] bool was_sent() const { return sent_at_.has_value(); }
  [[nodiscard]] bool is_due(HostTime now) const {
    return packet_ && !(sent_at_ && now - *sent_at_ < patience_ * std::max(timer_.wait(), kShortestWait));
  }
  /// The packet to send now, if it is due.
  [[nodiscard]] std::optional<CrtpPacket> take_due(HostTime now) {
    if (!is_due(now)) return std::nullopt;
    if (sent_at_) timer_.on_repetition();
    was_repeated_ = sent_at_.has_value();
    sent_at_ = now;
    return packet_;
  }
  /// Each packet from the vehicle, before it is answered by ask() or drop().
  void on_frame(std::span<const std::uint8_t> packet, HostTime at) {
    const bool is_answer = packet_ && !packet.empty() && ((packet[0] ^ (*packet_)[0]) & kTopicBits) == 0;
    if (is_answer && sent_at_ && !was_repeated_) timer_.on_round_trip(at - *sent_at_);
  }
  [[nodiscard]] const RepeatTimer& timer() const { return timer_; }

 private:
  std::optional<CrtpPacket> packet_;
  int patience_ = 1;
  std::optional<HostTime> sent_at_;
  bool was_repeated_ = false;
  RepeatTimer timer_;
};

}  // namespace swiftlet
