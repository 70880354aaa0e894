// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/mapping/picture/painter.hpp"

/// How the parts of the map picture look; the legend and the map take it from here.
namespace swiftlet::map_style {

inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kUnknown{226, 229, 233};
inline constexpr Colour kInk{44, 50, 58};
inline constexpr Pen kOdometry{{150, 157, 166}, 1.3, 0.85};
inline constexpr Pen kWall{{23, 62, 108}, 2.0, 0.8};
inline constexpr Pen kClosure{{22, 150, 80}, 1.1, 0.35};
inline constexpr Pen kDropped{{205, 52, 52}, 1.3, 0.8};
inline constexpr double kPathWidthPx = 2.6;
inline constexpr double kStartRadiusPx = 9.0;
inline constexpr double kEndRadiusPx = 6.0;

/// `percent` 0..100. A cell that one beam passed is already white, one that is more likely a wall is dark.
[[nodiscard]] Colour occupancy_colour(int percent);
/// `age` 0 at the start of the run, 1 at its end: blue over violet to orange.
[[nodiscard]] Colour time_colour(double age);

}  // namespace swiftlet::map_style
