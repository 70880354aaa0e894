// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/nearest_wall.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/moments2.hpp"

namespace swiftlet {
namespace {

constexpr double kRadiusM = 0.3;
constexpr std::size_t kMinReturns = 5;
constexpr double kMinVarianceM2 = 0.004;  // along the wall
constexpr double kMaxVarianceRatio = 0.35;

double distance_m(const Point2& a, const Point2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

std::optional<Point2> nearest_wall_normal(std::span<const Point2> returns, const Point2& place) {
  if (returns.empty()) return std::nullopt;
  const Point2 nearest = *std::min_element(
      returns.begin(), returns.end(),
      [&](const Point2& a, const Point2& b) { return distance_m(a, place) < distance_m(b, place); });
  Moments2 moments;
  for (const Point2& p : returns)
    if (distance_m(p, nearest) <= kRadiusM) moments.add({p.x_m - nearest.x_m, p.y_m - nearest.y_m});
  const Scatter2 scatter = moments.scatter();
  if (moments.count < kMinReturns || scatter.along() < kMinVarianceM2 ||
      scatter.across() > kMaxVarianceRatio * scatter.along())
    return std::nullopt;
  return scatter.normal();
}

}  // namespace swiftlet
