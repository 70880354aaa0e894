// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Unit normal of the wall that is nearest to a place: of the line through the returns around the nearest
/// one, by the limits of joint refinement (WallFitTuning). Nothing where they are too few or draw no line.
[[nodiscard]] std::optional<Point2> nearest_wall_normal(std::span<const Point2> returns, const Point2& place);

}  // namespace swiftlet
