// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/mapping/map_tuning.hpp"

namespace swiftlet {

/// Settings of the occupancy map that is published and written. One set serves all places and sensors.
struct MapConfig {
  double resolution_m = 0.05;
  double hit_log_odds = 0.85;
  double miss_log_odds = -0.4;
  double clear_range_m = 3.0;

  static constexpr SettingsSection kSection{"map", "The occupancy map that is published and written."};
  static constexpr Setting<MapConfig> kSettings[] = {
      {"resolution_m", &MapConfig::resolution_m, "m", "cell size of the map that is published and written",
       0.01, 1},
      {"hit_log_odds", &MapConfig::hit_log_odds, "", "what one beam's end adds to its cell", 0.01, 10},
      {"miss_log_odds", &MapConfig::miss_log_odds, "", "what one beam adds to each cell it passes through",
       -10, -0.001},
      {"clear_range_m", &MapConfig::clear_range_m, "m", "beams clear cells up to this distance at most", 0.1,
       100},
  };

  MapTuning tuning{};  ///< no setting: for experiments

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const { return setting_problems(*this); }
};

}  // namespace swiftlet
