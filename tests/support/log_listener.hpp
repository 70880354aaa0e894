// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"

namespace swiftlet {

/// The plainest client of a vehicle's log: one block of two variables at 10 Hz, made anew whenever its data
/// stays away; requests repeat after 200 ms. Independent of radios: what it receives is the link's doing.
/// Link and clock must outlive it. One thread at a time.
class LogListener {
 public:
  LogListener(Link& link, LinkClock& clock) : link_(link), clock_(clock) {}

  /// Listens that long.
  void listen(Duration duration);

  /// All log packets received, in order.
  [[nodiscard]] const std::vector<LinkFrame>& received() const { return received_; }
  /// When the first log packet after `time` was received; nullopt: none was.
  [[nodiscard]] std::optional<HostTime> first_after(HostTime time) const;
  /// Answers to requests that were received.
  [[nodiscard]] std::uint64_t replies() const { return replies_; }

 private:
  void ask();
  void on_frame(const LinkFrame& frame);

  Link& link_;
  LinkClock& clock_;
  bool made_ = false;  // the block exists, it is to be started
  HostTime asked_at_ = HostTime::min();
  HostTime data_at_ = HostTime::min();
  std::uint64_t replies_ = 0;
  std::vector<LinkFrame> received_;
};

}  // namespace swiftlet
