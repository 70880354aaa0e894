// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/max_pyramid.hpp"

#include <algorithm>
#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

struct Size {
  int width = 0;
  int height = 0;
};

/// out(x, y) = max(in(x - shift, y), in(x, y)) with out wider by `shift`, then the same along y.
std::vector<std::uint8_t> widen(const std::vector<std::uint8_t>& in, Size size, int shift) {
  const int wide = size.width + shift;
  const int tall = size.height + shift;
  const auto at = [](int stride, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
  };
  std::vector<std::uint8_t> rows(at(wide, 0, size.height), 0);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::uint8_t value = in[at(size.width, x, y)];
      auto& left = rows[at(wide, x, y)];
      left = std::max(left, value);
      auto& right = rows[at(wide, x + shift, y)];
      right = std::max(right, value);
    }
  }
  std::vector<std::uint8_t> out(at(wide, 0, tall), 0);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < wide; ++x) {
      const std::uint8_t value = rows[at(wide, x, y)];
      auto& low = out[at(wide, x, y)];
      low = std::max(low, value);
      auto& high = out[at(wide, x, y + shift)];
      high = std::max(high, value);
    }
  }
  return out;
}

}  // namespace

MaxPyramid::MaxPyramid(const GridGeometry& geometry, std::vector<std::uint8_t> cells, int levels)
    : geometry_(geometry) {
  SWIFTLET_CHECK(levels >= 1, "a pyramid has at least its base");
  SWIFTLET_CHECK(cells.size() == geometry.cell_count(), "the cells fill the grid");
  grids_.push_back(std::move(cells));
  for (int level = 1; level < levels; ++level) {
    const int reach = (1 << (level - 1)) - 1;
    grids_.push_back(
        widen(grids_.back(), {geometry.width + reach, geometry.height + reach}, 1 << (level - 1)));
  }
}

std::vector<std::uint8_t> max_kernel(const GridGeometry& geometry, const std::vector<std::uint8_t>& cells,
                                     int width) {
  const int reach = width / 2;
  std::vector<std::uint8_t> out(cells.size(), 0);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const std::uint8_t value = cells[geometry.offset({x, y})];
      if (value == 0) continue;
      for (int v = std::max(0, y - reach); v <= std::min(geometry.height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(geometry.width - 1, x + reach); ++u) {
          auto& cell = out[geometry.offset({u, v})];
          cell = std::max(cell, value);
        }
      }
    }
  }
  return out;
}

}  // namespace swiftlet
