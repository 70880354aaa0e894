// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <vector>

#include "core/geometry/grid.hpp"
#include "core/mapping/picture/map_scene.hpp"

namespace swiftlet {

/// The wall moved and turned onto the occupied cells within 0.25 m of it, by total least squares; as it is
/// where there are too few. The frontend drew it before the refinement moved the scans behind it.
[[nodiscard]] MapSegment fitted_to_grid(const MapSegment& wall, double resolution_m,
                                        const std::function<bool(CellIndex)>& is_occupied);

/// The parts of a wall along which the grid is occupied within 0.1 m of it, gaps of up to 0.4 m closed, parts
/// shorter than 0.4 m left out. The frontend's walls know nothing of what the backend's
/// final refinement did to the scans behind them: for a picture, the grid says how far each still holds.
/// `is_occupied` answers for a cell of `resolution_m`.
[[nodiscard]] std::vector<MapSegment> supported_parts(const MapSegment& wall, double resolution_m,
                                                      const std::function<bool(CellIndex)>& is_occupied);

/// What is left when each stretch of wall is told once: the longest walls whole, of the others the parts of
/// at least 0.4 m that do not run within 0.25 m and 20 degrees of one already told. Every traversal sees a
/// wall anew; a picture with all of them shows one wall several times over.
[[nodiscard]] std::vector<MapSegment> distinct_walls(std::vector<MapSegment> walls);

}  // namespace swiftlet
