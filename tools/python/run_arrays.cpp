// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/python/run_arrays.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/mapping/picture/map_scene.hpp"
#include "daemon/outputs/ros_map.hpp"

namespace swiftlet {
namespace {

void append_pose(std::vector<double>& rows, HostTime stamp, const Pose2& pose) {
  rows.insert(rows.end(), {to_seconds(stamp.time_since_epoch()), pose.x_m(), pose.y_m(), pose.yaw_rad()});
}

void append_covariance(std::vector<double>& rows, const Covariance3& P) {
  rows.insert(rows.end(), {P.xx, P.xy, P.x_yaw, P.xy, P.yy, P.y_yaw, P.x_yaw, P.y_yaw, P.yaw_yaw});
}

void append(SegmentArrays& arrays, std::span<const MapSegment> segments, std::int8_t storey) {
  for (const MapSegment& segment : segments)
    arrays.rows.insert(arrays.rows.end(), {segment.start_map.x_m, segment.start_map.y_m, segment.end_map.x_m,
                                           segment.end_map.y_m});
  arrays.storeys.insert(arrays.storeys.end(), segments.size(), storey);
}

OccupancyGrid grid_of(const MapScene& scene) {
  std::vector<TileIndex> indices;
  for (const MapTile& tile : scene.tiles) indices.push_back(tile.index);
  const TileRange range = range_of(indices);
  OccupancyGrid grid;
  grid.rows = range.height_cells();
  grid.columns = range.width_cells();
  grid.resolution_m = scene.resolution_m;
  grid.origin_map = {range.low.x * kTileCells * scene.resolution_m,
                     range.low.y * kTileCells * scene.resolution_m};
  grid.occupancy_percent.assign(grid.rows * grid.columns, -1);
  for (const MapTile& tile : scene.tiles) {
    const std::size_t left = static_cast<std::size_t>(tile.index.x - range.low.x) * kTileCells;
    const std::size_t low = static_cast<std::size_t>(tile.index.y - range.low.y) * kTileCells;
    for (std::size_t row = 0; row < kTileCells; ++row)
      std::copy_n(tile.occupancy_percent.data() + row * kTileCells, kTileCells,
                  grid.occupancy_percent.data() + (low + row) * grid.columns + left);
  }
  return grid;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Covariance3 kNoCovariance{kNan, kNan, kNan, kNan, kNan, kNan};

}  // namespace

Result<RunArrays> arrays_of(const MappedRun& run) {
  RunArrays arrays;
  const std::span<const DoubtedPose> published = run.poses_with_doubt();
  auto doubt = published.begin();
  const Status visited = for_each_scan(run.view(), [&](const TrajectoryPoint& at) {
    arrays.storeys.push_back(static_cast<std::int8_t>(index_of(at.storey)));
    append_pose(arrays.trajectory, at.stamp, at.T_map_body);
    append_pose(arrays.live, at.stamp, at.T_map_live);
    append_pose(arrays.odometry, at.stamp, at.T_odom_body);
    while (doubt != published.end() && doubt->stamp < at.stamp) ++doubt;
    const bool is_known = doubt != published.end() && doubt->stamp == at.stamp;
    append_covariance(arrays.covariances, is_known ? doubt->from_start : kNoCovariance);
    append_covariance(arrays.covariances_map, is_known ? doubt->from_surroundings : kNoCovariance);
  });
  if (!visited) return visited.error();
  for (const StampedPose& at : run.view().truth) append_pose(arrays.truth, at.stamp, at.pose);
  for (const StoreyId storey : run.view().map.storeys()) {
    const MapScene scene = make_map_scene(run.backend(), run.view().map, storey);
    const auto number = static_cast<std::int8_t>(index_of(storey));
    append(arrays.walls, scene.walls, number);
    append(arrays.closures, scene.closures, number);
    append(arrays.dropped_closures, scene.dropped_closures, number);
    arrays.grids.emplace(storey, grid_of(scene));
  }
  return arrays;
}

}  // namespace swiftlet
