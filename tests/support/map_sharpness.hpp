// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <utility>

#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// How blurred a map is, without ground truth: distinct cells of 0.2 m that returns of 0.05 to 2 m fall into
/// when drawn from the given poses, one a sample. Walls drawn twice take more cells.
inline std::size_t cells_hit(std::span<const RangeSample> samples, std::span<const Pose2> T_map_body,
                             const BeamLayout& beams) {
  constexpr double kCellM = 0.2;
  std::set<std::pair<long, long>> cells;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t beam = 0; beam < samples[i].beam_count; ++beam) {
      const double range_m = static_cast<double>(samples[i].distance_m[beam]);
      if (samples[i].status[beam] != RangeStatus::kHit || range_m <= 0.05 || range_m >= 2.0) continue;
      const double bearing_rad = beams.bearing_rad[beam];
      const Point2 p =
          T_map_body[i] * Point2{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)};
      cells.emplace(std::lround(std::floor(p.x_m / kCellM)), std::lround(std::floor(p.y_m / kCellM)));
    }
  }
  return cells.size();
}

}  // namespace swiftlet
