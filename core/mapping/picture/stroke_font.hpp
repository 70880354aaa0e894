// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

/// The letters on the map picture, as strokes of a pen: sharp at any size, no font file needed.
namespace swiftlet::stroke_font {

/// In font units: x to the right, y up, the baseline at 0.
struct Point {
  double x = 0.0;
  double y = 0.0;
};
using Stroke = std::vector<Point>;  ///< a polyline; a single point is a dot

struct Glyph {
  double width = 0.0;
  std::vector<Stroke> strokes;
};

inline constexpr double kHeight = 8.0;   ///< of digits and tall letters
inline constexpr double kSpacing = 2.0;  ///< between two letters

/// Upper case is drawn as lower case; what the font does not have is a space.
[[nodiscard]] const Glyph& glyph_of(char letter);

}  // namespace swiftlet::stroke_font
