// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/places_file.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <map>

namespace swiftlet {

Result<std::string> places_csv(const RunView& run) {
  std::multimap<HostTime, std::string> names;
  for (const MarkedPlace& place : run.places) names.emplace(place.stamp, place.name);
  std::string text = "name,time_s,x_m,y_m,yaw_rad,storey\n";
  const auto append = [&](const TrajectoryPoint& at) {
    const auto [first, last] = names.equal_range(at.stamp);
    for (auto place = first; place != last; ++place) {
      const auto us =
          std::chrono::duration_cast<std::chrono::microseconds>(at.stamp.time_since_epoch()).count();
      std::array<char, 128> numbers{};
      std::snprintf(numbers.data(), numbers.size(), ",%lld.%06lld,%.6f,%.6f,%.6f,%u\n",
                    static_cast<long long>(us / 1'000'000), static_cast<long long>(us % 1'000'000),
                    at.T_map_body.x_m(), at.T_map_body.y_m(), at.T_map_body.yaw_rad(), index_of(at.storey));
      text.append(place->second).append(numbers.data());
    }
    names.erase(first, last);  // of two scans with one stamp the first has the place
  };
  if (Status visited = for_each_scan(run, append); !visited) return visited.error();
  return text;
}

}  // namespace swiftlet
