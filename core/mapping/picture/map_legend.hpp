// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/mapping/picture/map_scene.hpp"
#include "core/mapping/picture/map_style.hpp"
#include "core/mapping/picture/map_view.hpp"
#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

inline constexpr int kLegendHeightPx = 64;
inline constexpr int kTitleHeightPx = 32;

/// The longest of 1, 2, 5, 10, 20, 50, .. metres whose bar is at most `max_px` long, or one metre.
[[nodiscard]] double scale_bar_length_m(double px_per_m, double max_px);

/// Fills the strip of kLegendHeightPx rows from `top_px` on: scale bar, time scale, and a key to the lines.
/// Keys that find no room on a narrow picture are left out from the right.
void draw_legend(RgbImage& image, int top_px, double px_per_m, const MapScene& scene);

/// Title, date (UTC) and length of the run in one line, of what is there.
[[nodiscard]] std::string title_text(const MapScene& scene);
/// Fills the strip of kTitleHeightPx rows from `top_px` on: the title, and whether the picture
/// `cuts_odometry` off.
void draw_title(RgbImage& image, int top_px, const MapScene& scene, bool cuts_odometry);

/// Ticks with metres of the map frame along the left and the lower edge of the map, which is `view`.
void draw_axes(RgbImage& image, const MapView& view);

}  // namespace swiftlet
