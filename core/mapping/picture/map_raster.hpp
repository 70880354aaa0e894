// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/mapping/picture/map_scene.hpp"
#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

/// The picture of a run: the grid in greys (white free, dark occupied, soft grey unknown), the odometry as a
/// thin grey line, the corrected path coloured by time, walls, loop closures green, dropped ones dashed red,
/// marks at start and end, metres along two edges; below it a scale bar, the legend, and title, date and
/// length. A pure function of the scene. The scale is chosen so that the longer side comes to between 1000
/// and 2000 pixels for anything from a room to a campus; the width is at least kMinWidthPx.
[[nodiscard]] RgbImage draw_map(const MapScene& scene);

/// The walls alone, at the same place and scale.
[[nodiscard]] RgbImage draw_plan(const MapScene& scene);

}  // namespace swiftlet
