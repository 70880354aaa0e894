// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

#include "core/base/tuning.hpp"

namespace swiftlet {

struct MapDrawingTuning {
  double follow_cells = 0.5;             ///< a scan is drawn anew where it would move farther
  std::size_t max_returns_moved = 4000;  ///< in one update: about a millisecond
  double lattice_per_cell = 4.0;         ///< positions that scans are rounded to
  double max_log_odds = 4.0;             ///< of a cell: between 2 and 98 percent

  static constexpr TuningValue<MapDrawingTuning> kValues[] = {
      {"follow_cells", &MapDrawingTuning::follow_cells},
      {"max_returns_moved", &MapDrawingTuning::max_returns_moved},
      {"lattice_per_cell", &MapDrawingTuning::lattice_per_cell},
      {"max_log_odds", &MapDrawingTuning::max_log_odds}};
};

/// The walls of a picture.
struct WallSupportTuning {
  int occupied_percent = 65;      ///< of a cell that supports a wall: occupied by several beams
  std::size_t min_fit_cells = 6;  ///< fewer move no wall
  double reach_m = 0.1;           ///< from a wall to the occupied cells that support it
  double bridge_m = 0.4;          ///< longer gaps without support part a wall, and shorter parts are left out
  double same_wall_m = 0.25;      ///< walls no farther apart than this ...
  double same_wall_rad = 0.35;    ///< ... and than this (20 degrees) are one
  double probe_m = 0.05;          ///< step along a wall that is compared with others

  static constexpr TuningValue<WallSupportTuning> kValues[] = {
      {"occupied_percent", &WallSupportTuning::occupied_percent},
      {"min_fit_cells", &WallSupportTuning::min_fit_cells},
      {"reach_m", &WallSupportTuning::reach_m},
      {"bridge_m", &WallSupportTuning::bridge_m},
      {"same_wall_m", &WallSupportTuning::same_wall_m},
      {"same_wall_rad", &WallSupportTuning::same_wall_rad},
      {"probe_m", &WallSupportTuning::probe_m}};
};

struct MapTuning {
  MapDrawingTuning drawing;
  WallSupportTuning walls;
};

}  // namespace swiftlet
