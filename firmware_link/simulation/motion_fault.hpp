// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

enum class MotionFaultKind : std::uint8_t {
  kSilence,   ///< nothing is received for that many seconds; the estimate runs on
  kReset,     ///< the estimate restarts, in flight
  kRestart,   ///< the vehicle restarts where it is, off for that many seconds
  kCarried,   ///< the same, but it restarts where it would have flown to in that many seconds
  kTeleport,  ///< likewise, unseen: the estimate goes on as if it had not been moved
  kSlip,      ///< the position stays for that many seconds while the vehicle flies on, unseen
  kYawJump,   ///< the heading jumps by that many degrees from one reading to the next, unseen
  kYawTurn,   ///< likewise over two seconds, as a vehicle might turn
};

/// What the estimate takes for it, interpolated between readings.
inline constexpr Duration kYawJumpTime = std::chrono::milliseconds(100);
inline constexpr Duration kYawTurnTime = std::chrono::seconds(2);

/// A break of the simulated dead reckoning.
struct MotionFault {
  MotionFaultKind kind{};
  Duration after{};     ///< the first sample
  double amount = 0.0;  ///< seconds or degrees, by kind
};

/// `KIND@SECONDS:AMOUNT`, several with commas between them, in the order of time. Kinds: silence, reset,
/// restart, carried, teleport, slip, jump, turn; a reset has no amount. Error: kInvalidInput: what is wrong.
[[nodiscard]] Result<std::vector<MotionFault>> parse_motion_faults(std::string_view text);

}  // namespace swiftlet
