// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

namespace swiftlet {

/// An event of a live vehicle or its link; recorded on the radio thread without text, which describe() gives
/// it.
struct VehicleEvent {
  enum class Kind : std::uint8_t {
    kReadingTable,   ///< its table of contents, not known yet; value: per cent
    kConnected,      ///< log data flows; value: CRTP protocol version
    kProtocolNewer,  ///< value: CRTP protocol version
    kDataStopped,    ///< no log data for a second: the session restarts when the vehicle is received
    kRebooted,       ///< its clock restarted
    kRefused,        ///< after a reconnection, it cannot be used (the session tries again)
    kNoMultiranger,
    kNoFlowDeck,
    kYawTrap,           ///< it is carried or pushed with its motors off
    kBatteryLow,        ///< value: millivolts
    kHeadingLeapt,      ///< its dead reckoning turned as it cannot; value: how often so far
    kRangesFrozen,      ///< in flight none of them has changed for seconds
    kOtherProgram,      ///< the vehicle answers questions that were not asked here, or its log is stopped
    kDoubledData,       ///< log data arrives twice
    kClientConnected,   ///< another program shares the link; value: its port
    kClientGone,        ///< it has left, or has sent nothing for seconds
    kClientRefused,     ///< a second one; value: its port
    kClientBlocksLost,  ///< the vehicle's log had to begin anew
  };
  Kind kind = Kind::kConnected;
  std::int32_t value = 0;
};
static_assert(std::is_trivially_copyable_v<VehicleEvent>);

/// Whether the user should act on it.
[[nodiscard]] bool is_warning(const VehicleEvent& event);
/// One line: what, and what to do. Allocates.
[[nodiscard]] std::string describe(const VehicleEvent& event);

}  // namespace swiftlet
