// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/mapping/picture/map_scene.hpp"
#include "core/mapping/picture/map_style.hpp"
#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

inline constexpr int kLegendHeightPx = 64;

/// The longest of 1, 2, 5, 10, 20, 50, .. metres whose bar is at most `max_px` long.
[[nodiscard]] double scale_bar_length_m(double px_per_m, double max_px);

/// Fills the strip of kLegendHeightPx rows from `top_px` on: scale bar, time scale, and a key to the lines.
/// Keys that find no room on a narrow picture are left out from the right.
void draw_legend(RgbImage& image, int top_px, double px_per_m, const MapScene& scene);

}  // namespace swiftlet
