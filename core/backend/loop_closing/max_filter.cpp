// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/max_filter.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

struct Size {
  int width = 0;
  int height = 0;
};

std::size_t cell_count(Size size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

/// out[i] = max(out[i], in[i]); plain enough for the compiler to take many bytes at once.
void raise(std::uint8_t* out, const std::uint8_t* in, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = std::max(out[i], in[i]);
}

/// out(x, y) = max(in(x - shift, y), in(x, y)) with out wider by `shift`, then the same along y.
std::vector<std::uint8_t> widen(std::span<const std::uint8_t> in, Size size, int shift) {
  const auto width = static_cast<std::size_t>(size.width);
  const Size wide{size.width + shift, size.height};
  const auto stride = static_cast<std::size_t>(wide.width);
  std::vector<std::uint8_t> rows(cell_count(wide), 0);
  for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y) {
    std::copy_n(in.data() + y * width, width, rows.data() + y * stride);
    raise(rows.data() + y * stride + shift, in.data() + y * width, width);
  }
  std::vector<std::uint8_t> out(cell_count({wide.width, wide.height + shift}), 0);
  std::copy(rows.begin(), rows.end(), out.begin());
  raise(out.data() + static_cast<std::size_t>(shift) * stride, rows.data(), rows.size());
  return out;
}

}  // namespace

std::vector<std::uint8_t> max_ahead(const GridGeometry& geometry, std::span<const std::uint8_t> cells,
                                    int side) {
  SWIFTLET_CHECK(cells.size() == geometry.cell_count(), "the cells fill the grid");
  std::vector<std::uint8_t> maxima(cells.begin(), cells.end());
  for (int width = 1; width < side; width *= 2)  // of the squares so far
    maxima = widen(maxima, {geometry.width + width - 1, geometry.height + width - 1}, width);
  return maxima;
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
