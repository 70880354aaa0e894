// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <type_traits>

#include "core/base/time.hpp"

namespace swiftlet {

/// A vehicle that was not received for that long is silent: it deletes its log blocks when it has received
/// nothing for a second.
inline constexpr Duration kLinkSilence = std::chrono::seconds(1);

/// The condition of a live link. Those after kSilent concern the device: the link retries by itself each
/// second.
enum class LinkCondition : std::uint8_t {
  kNone,       ///< not a live link: a recording or a simulation
  kConnected,  ///< the vehicle was received within the last kLinkSilence
  kSilent,     ///< the device works, the vehicle does not answer: switched off, out of range, other address
  kDeviceMissing,    ///< no such dongle or cable plugged in
  kAccessDenied,     ///< it is plugged in, but this user may not open it
  kDeviceBusy,       ///< another program uses it
  kDeviceStalls,     ///< it refuses transfers
  kDeviceOverflows,  ///< it sends more than it may
  kDeviceMute,       ///< it does not answer in time
  kDeviceFault,      ///< any other error: I/O
  kDeviceUnsuited,   ///< it has not the data rate or the channel asked for
};

/// Counters of a link since it was opened; copied into the status message. Rates are differences of them.
struct LinkStatistics {
  LinkCondition condition = LinkCondition::kNone;
  std::uint64_t packets_sent = 0;  ///< every transmission, polls and repetitions too
  std::uint64_t packets_acked =
      0;  ///< of those, acknowledged (cable: all; UDP: sent while the vehicle is received)
  std::uint64_t radio_retries = 0;     ///< retransmissions by the dongle, if it reports them
  std::uint64_t packets_received = 0;  ///< with content: null packets left out
  std::uint64_t duplicates = 0;        ///< downlink packets received twice and dropped by safelink
  std::uint64_t silences = 0;          ///< times the vehicle was not received for kLinkSilence
  std::uint64_t device_losses = 0;     ///< times the device had to be reopened
  std::uint64_t usb_timeouts = 0;      ///< answers that did not come in time and were drained
  bool safelink = false;               ///< in use at present
};
static_assert(std::is_trivially_copyable_v<LinkStatistics>);

}  // namespace swiftlet
