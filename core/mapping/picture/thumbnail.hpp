// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

/// The image divided by the least whole factor that makes its longer side at most `longest_px`; each pixel is
/// the mean of those it stands for. Rows and columns beyond a whole number of pixels are left out.
/// Precondition: longest_px > 0.
[[nodiscard]] RgbImage thumbnail_of(const RgbImage& image, int longest_px);

}  // namespace swiftlet
