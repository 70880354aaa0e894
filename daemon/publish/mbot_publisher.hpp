// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "daemon/publish/lcm_publisher.hpp"
#include "daemon/publish/publisher.hpp"

namespace swiftlet {

/// Of a map in one message: 20 m by 20 m at 5 cm. Of a larger one, cells of twice, four times the side are
/// sent, so that a receiver with the kernel's default buffer gets all fragments of the message.
inline constexpr std::size_t kMaxMbotCells = 160'000;

/// Log odds as an MBot's map has them, from percent occupied: above 0 where map.pgm is occupied, below 0
/// where it is free, else 0.
[[nodiscard]] std::int8_t mbot_log_odds(std::int8_t occupancy_percent);

/// Publishes as `own` does, and the same pose, dead reckoning, beams and, with each summary of the map, the
/// whole map to `sink`, as the programs of MBot robots have them (mbot_lcm_msgs; docs/lcm.md).
[[nodiscard]] std::unique_ptr<Publisher> make_mbot_publisher(std::unique_ptr<Publisher> own,
                                                             MessageSink sink);

}  // namespace swiftlet
