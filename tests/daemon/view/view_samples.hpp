// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include <stdexcept>

#include "core/mapping/map_tile.hpp"
#include "daemon/view/run_history.hpp"

namespace swiftlet {

inline constexpr std::int64_t kSecondUs = 1'000'000;

/// A tile all of whose cells hold `percent`.
inline MapTile uniform_tile(TileIndex index, std::uint32_t version, std::int8_t percent) {
  MapTile tile{.index = index, .version = version};
  tile.occupancy_percent.fill(percent);
  return tile;
}

/// The value that was found; where none was, the test fails.
template <typename Entry>
const auto& value_of(const Entry* entry) {
  if (entry == nullptr) throw std::out_of_range("nothing was found");
  return entry->value;
}

/// Adds a pose, in all its frames.
inline void add_whole_pose(RunHistory& history, std::int64_t utime_us, std::int32_t sequence) {
  history.add_pose({.utime_us = utime_us, .sequence = sequence, .map = {1.0, 2.0, 0.5}});
  history.add_local(sequence, {2.0, 3.0, 0.5});
  history.add_odom(sequence, {3.0, 4.0, 0.25});
}

}  // namespace swiftlet
