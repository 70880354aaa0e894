// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <vector>

#include "core/geometry/grid.hpp"
#include "core/mapping/map_tuning.hpp"
#include "core/mapping/picture/map_scene.hpp"

namespace swiftlet {

/// The wall moved and turned onto the occupied cells beside it, by total least squares; as it is
/// where there are too few. The frontend drew it before the refinement moved the scans behind it.
[[nodiscard]] MapSegment fitted_to_grid(const MapSegment& wall, double resolution_m,
                                        const std::function<bool(CellIndex)>& is_occupied,
                                        const WallSupportTuning& tuning = {});

/// The parts of a wall along which the grid is occupied, short gaps closed, short parts left out. The
/// frontend's walls are older than the backend's final refinement of the scans behind them: for a picture,
/// the grid decides how far each still holds. `is_occupied` answers for a cell of `resolution_m`.
[[nodiscard]] std::vector<MapSegment> supported_parts(const MapSegment& wall, double resolution_m,
                                                      const std::function<bool(CellIndex)>& is_occupied,
                                                      const WallSupportTuning& tuning = {});

/// Each stretch of wall once: the longest walls whole, of the others the parts that do not run along one that
/// is there already. Every traversal sees a wall anew; a picture with all of them shows one wall several
/// times over.
[[nodiscard]] std::vector<MapSegment> distinct_walls(std::vector<MapSegment> walls,
                                                     const WallSupportTuning& tuning = {});

}  // namespace swiftlet
