// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_style.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::map_style {

Colour occupancy_colour(int percent) {
  constexpr double kWhiteUpTo = 42.0;
  constexpr double kDarkFrom = 90.0;
  const double share = std::clamp((percent - kWhiteUpTo) / (kDarkFrom - kWhiteUpTo), 0.0, 1.0);
  return mix(kPaper, kInk, share);
}

Colour time_colour(double age) {
  constexpr std::array<Colour, 5> kStops{
      {{38, 70, 200}, {118, 50, 196}, {196, 44, 148}, {234, 80, 84}, {246, 146, 30}}};
  const double place = std::clamp(age, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  return mix(kStops[stop], kStops[stop + 1], place - static_cast<double>(stop));
}

}  // namespace swiftlet::map_style
