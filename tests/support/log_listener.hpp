// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_link/crtp_packet.hpp"
#include "firmware_link/link.hpp"
#include "firmware_link/link_clock.hpp"

namespace swiftlet {

/// The plainest client of a vehicle's log: one block of two variables at 10 Hz, made anew whenever its data
/// stays away; requests repeat after 200 ms. Knows nothing of radios: what it hears is the link's doing. Link
/// and clock must outlive it. One thread at a time.
class LogListener {
 public:
  LogListener(Link& link, LinkClock& clock) : link_(link), clock_(clock) {}

  /// Listens that long.
  void listen(Duration duration);

  /// All log packets heard, in order.
  [[nodiscard]] const std::vector<LinkFrame>& heard() const { return heard_; }
  /// When the first log packet after `time` was heard; nullopt: none was.
  [[nodiscard]] std::optional<HostTime> first_after(HostTime time) const;
  /// Answers to requests that were heard.
  [[nodiscard]] std::uint64_t replies() const { return replies_; }

 private:
  void ask();
  void hear(const LinkFrame& frame);

  Link& link_;
  LinkClock& clock_;
  bool made_ = false;  // the block exists, it is to be started
  HostTime asked_at_ = HostTime::min();
  HostTime data_at_ = HostTime::min();
  std::uint64_t replies_ = 0;
  std::vector<LinkFrame> heard_;
};

}  // namespace swiftlet
