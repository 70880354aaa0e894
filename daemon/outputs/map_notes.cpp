// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/map_notes.hpp"

#include <spdlog/fmt/fmt.h>

namespace swiftlet {

std::vector<std::string> map_notes(const BackendCounters& counters) {
  std::vector<std::string> notes;
  if (counters.map_source == MapSource::kOtherYawNoise)
    notes.push_back(
        fmt::format("the map is that of the run mapped again with {:g} times the noise of the heading: it "
                    "explains the ranges better",
                    counters.yaw_noise_factor));
  else if (counters.map_source == MapSource::kBackwards)
    notes.emplace_back(
        "the map is that of the run mapped again from its end to its start: it explains the ranges better");
  else if (!follows_closures(counters.map_source))
    notes.push_back(
        fmt::format("the map follows {} alone, which explains the ranges no worse than loop closures do",
                    name_of(counters.map_source)));
  if (counters.floor_cost > 0.0)
    notes.emplace_back(
        "over some floors the flow sensor misses a part of the motion: the map makes up for it");
  return notes;
}

}  // namespace swiftlet
