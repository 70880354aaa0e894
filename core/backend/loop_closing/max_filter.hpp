// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/grid.hpp"

namespace swiftlet {

/// Each cell becomes the maximum over the `side` x `side` cells that begin there: bounds of a search by
/// tiles. In a grid that begins side - 1 cells before the given one, where such squares first touch it, and
/// is that much wider and higher. `cells` has geometry.cell_count() values, row by row; `side` is a power of
/// two.
std::vector<std::uint8_t> max_ahead(const GridGeometry& geometry, std::span<const std::uint8_t> cells,
                                    int side);

/// Each cell becomes the maximum over the `width` x `width` cells around it (eq. 22). `width` odd.
std::vector<std::uint8_t> max_kernel(const GridGeometry& geometry, const std::vector<std::uint8_t>& cells,
                                     int width);

}  // namespace swiftlet
