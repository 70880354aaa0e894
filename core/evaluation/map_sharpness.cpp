// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/map_sharpness.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

struct DrawnPoint {
  StoreyId storey{};
  Point2 p_map;
};

std::size_t cells_hit(std::span<const DrawnPoint> points, double cell_m) {
  std::vector<std::tuple<StoreyId, double, double>> cells;
  cells.reserve(points.size());
  for (const DrawnPoint& drawn : points)
    cells.emplace_back(drawn.storey, std::floor(drawn.p_map.x_m / cell_m),
                       std::floor(drawn.p_map.y_m / cell_m));
  std::sort(cells.begin(), cells.end());
  return static_cast<std::size_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
}

}  // namespace

MapSharpness map_sharpness(std::span<const RangeSample> samples, std::span<const Pose2> T_map_body,
                           const BeamLayout& beams) {
  SWIFTLET_CHECK(samples.size() == T_map_body.size(), "each sample is drawn from a pose of its own");
  std::vector<DrawnPoint> points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t beam = 0; beam < samples[i].beam_count; ++beam) {
      const float distance_m = samples[i].distance_m[beam];
      const bool counts = samples[i].status[beam] == RangeStatus::kHit &&
                          distance_m > MapSharpness::kMinRangeM && distance_m < MapSharpness::kMaxRangeM;
      if (!counts) continue;
      const auto range_m = static_cast<double>(distance_m);
      const double bearing_rad = beams.bearing_rad[beam];
      const Point2 p_body{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)};
      points.push_back({samples[i].storey, T_map_body[i] * p_body});
    }
  }
  return {points.size(), cells_hit(points, 0.1), cells_hit(points, 0.2)};
}

FlightSharpness flight_sharpness(std::span<const RangeSample> samples, const StampedPath& path,
                                 const BeamLayout& beams) {
  FlightSharpness flight;
  std::vector<RangeSample> drawn;
  std::vector<Pose2> T_map_body;
  for (const RangeSample& sample : samples) {
    const bool is_outside = path.poses().empty() || sample.stamp < path.poses().front().stamp - kPathMargin ||
                            sample.stamp > path.poses().back().stamp + kPathMargin;
    if (is_outside) {
      flight.outside.push_back(sample.stamp);
      continue;
    }
    if (path.nearest(sample.stamp) == nullptr) ++flight.interpolated;
    drawn.push_back(sample);
    T_map_body.push_back(path.interpolated(sample.stamp));
  }
  flight.drawn = drawn.size();
  flight.map = map_sharpness(drawn, T_map_body, beams);
  return flight;
}

}  // namespace swiftlet
