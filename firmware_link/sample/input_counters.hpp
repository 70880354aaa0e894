// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <type_traits>

namespace swiftlet {

/// What an input has counted so far. Trivially copyable: reports, status messages and queues embed it.
struct InputCounters {
  std::uint64_t frames = 0;   ///< radio frames (laser logs: lines) read
  std::uint64_t samples = 0;  ///< samples delivered
  std::uint64_t range_packets = 0;
  std::uint64_t odometry_packets = 0;
  std::uint64_t duplicates = 0;       ///< same block, same device time: dropped
  std::uint64_t out_of_order = 0;     ///< device time went back: dropped
  std::uint64_t gaps = 0;             ///< holes of more than 1.5 periods between range packets
  std::uint64_t missing_packets = 0;  ///< range packets those holes stand for
  std::uint64_t repeated = 0;         ///< range packets with the measurement of the one before: dropped
  std::uint64_t unpaired = 0;         ///< range packets without dead reckoning around them: dropped
  std::uint64_t leaps = 0;            ///< steps of the dead reckoning that are no motion
  std::uint64_t too_far = 0;          ///< range packets where the dead reckoning has run away: dropped
  std::uint64_t segments = 0;         ///< starts of the dead reckoning (1 for an undisturbed run)
  std::uint64_t hits = 0;             ///< beams by status
  std::uint64_t no_returns = 0;
  std::uint64_t invalid = 0;
  std::uint64_t floor_returns = 0;  ///< of the invalid ones: a tilted beam can have met the floor
};
static_assert(std::is_trivially_copyable_v<InputCounters>);

}  // namespace swiftlet
