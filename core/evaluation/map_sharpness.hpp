// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// The blur of a map, without ground truth: the number of distinct cells with returns, on all storeys. Walls
/// drawn twice take more cells. Only returns between these limits count, the limits excluded.
struct MapSharpness {
  static constexpr float kMinRangeM = 0.05F;
  static constexpr float kMaxRangeM = 2.0F;

  std::size_t returns = 0;
  std::size_t cells_10_cm = 0;  ///< of 0.1 m
  std::size_t cells_20_cm = 0;  ///< of 0.2 m
};

/// Of samples drawn from the given poses, one for each sample. Precondition: same size.
[[nodiscard]] MapSharpness map_sharpness(std::span<const RangeSample> samples,
                                         std::span<const Pose2> T_map_body, const BeamLayout& beams);

/// A sample may be this much earlier or later than a path that it is drawn from: half a period, rounded up.
inline constexpr Duration kPathMargin = std::chrono::milliseconds(60);

/// Of a flight drawn along a path.
struct FlightSharpness {
  MapSharpness map;
  std::size_t drawn = 0;          ///< samples
  std::size_t interpolated = 0;   ///< those of `drawn` without a pose of their own (StampedPath::nearest)
  std::vector<HostTime> outside;  ///< samples not drawn: before the path begins or after it ends
};
[[nodiscard]] FlightSharpness flight_sharpness(std::span<const RangeSample> samples, const StampedPath& path,
                                               const BeamLayout& beams);

}  // namespace swiftlet
