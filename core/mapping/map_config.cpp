// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_config.hpp"

namespace swiftlet {

std::vector<std::string> MapConfig::validate() const {
  std::vector<std::string> problems;
  // Written so that a NaN fails too.
  const auto require = [&problems](bool fine, const char* problem) {
    if (!fine) problems.emplace_back(problem);
  };
  require(resolution_m >= 0.01 && resolution_m <= 1.0, "map.resolution_m must lie between 0.01 and 1");
  require(hit_log_odds > 0.0 && hit_log_odds <= 10.0, "map.hit_log_odds must lie above 0 and up to 10");
  require(miss_log_odds < 0.0 && miss_log_odds >= -10.0,
          "map.miss_log_odds must lie below 0 and down to -10");
  require(clear_range_m > 0.0 && clear_range_m <= 100.0, "map.clear_range_m must lie above 0 and up to 100");
  return problems;
}

}  // namespace swiftlet
