// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/base/ids.hpp"
#include "core/base/result.hpp"
#include "core/geometry/point2.hpp"
#include "tools/mapped_run.hpp"

namespace swiftlet {

/// The occupancy map in one piece: row by row from the lowest y, each from the lowest x.
struct OccupancyGrid {
  std::vector<std::int8_t> occupancy_percent;  ///< 0 to 100, -1 unknown
  std::size_t rows = 0;
  std::size_t columns = 0;
  double resolution_m = 0.0;
  Point2 origin_map;  ///< the outer corner of the first cell
};

inline constexpr std::size_t kPoseColumns = 4;  ///< time in s since 1970, x and y in m, yaw in rad
inline constexpr std::size_t kSegmentColumns =
    4;  ///< x and y of its start, x and y of its end, in m, frame map
inline constexpr std::size_t kCovarianceSide = 3;  ///< x, y, yaw

/// Lines on the map of a building.
struct SegmentArrays {
  std::vector<double> rows;
  std::vector<std::int8_t> storeys;  ///< one for each row
};

/// What a run comes to, as rows of numbers. The first six have a row for each scan, in the same order.
struct RunArrays {
  std::vector<std::int8_t> storeys;     ///< where each scan was taken
  std::vector<double> trajectory;       ///< corrected poses in frame map
  std::vector<double> live;             ///< poses in frame map as they were published
  std::vector<double> odometry;         ///< dead reckoning as reported, in frame odom
  std::vector<double> covariances;      ///< of `live` relative to the start of the run; NaN where not known
  std::vector<double> covariances_map;  ///< likewise, relative to the part of the map around the vehicle
  std::vector<double> truth;            ///< poses in frame world, where they are known
  SegmentArrays walls;                  ///< storey by storey, as the pictures have them
  SegmentArrays closures;               ///< likewise, from keyframe to keyframe
  SegmentArrays dropped_closures;       ///< likewise: refused in the final pass
  std::map<StoreyId, OccupancyGrid> grids;  ///< with the first
};

/// Errors: as PrunedScans::for_each_scan(). Allocates.
[[nodiscard]] Result<RunArrays> arrays_of(const MappedRun& run);

}  // namespace swiftlet
