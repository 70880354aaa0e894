// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

namespace swiftlet {

/// Settings of the occupancy map that is published and written. One set serves all places and sensors.
struct MapConfig {
  double resolution_m = 0.05;   ///< cell size
  double hit_log_odds = 0.85;   ///< what one beam's end adds to its cell
  double miss_log_odds = -0.4;  ///< what one beam adds to each cell it traversals through
  double clear_range_m = 3.0;   ///< beams clear cells up to this distance at most

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace swiftlet
