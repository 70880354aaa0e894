// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_scene.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "core/backend/backend.hpp"
#include "core/mapping/map_builder.hpp"
#include "core/mapping/picture/wall_support.hpp"

namespace swiftlet {

namespace {

class OccupiedCells {
 public:
  OccupiedCells(const std::vector<MapTile>& tiles, int occupied_percent)
      : occupied_percent_(occupied_percent) {
    for (const MapTile& tile : tiles) tiles_.emplace(std::pair{tile.index.x, tile.index.y}, &tile);
  }
  bool operator()(CellIndex cell) const {
    const std::pair index{floor_divide(cell.x), floor_divide(cell.y)};
    const auto found = tiles_.find(index);
    if (found == tiles_.end()) return false;
    const int i = (cell.y - index.second * kTileCells) * kTileCells + (cell.x - index.first * kTileCells);
    return found->second->occupancy_percent[static_cast<std::size_t>(i)] >= occupied_percent_;
  }

 private:
  static int floor_divide(int cell) { return cell >= 0 ? cell / kTileCells : (cell + 1) / kTileCells - 1; }
  int occupied_percent_;
  std::map<std::pair<int, int>, const MapTile*> tiles_;
};

void add_walls(MapScene& scene, const Backend& backend, StoreyId storey, const WallSupportTuning& tuning) {
  const OccupiedCells is_occupied(scene.tiles, tuning.occupied_percent);
  for (const Wall& wall : backend.walls()) {
    if (backend.keyframes().storey(wall.anchor) != storey) continue;
    const Pose2& T_map_anchor = backend.T_map_keyframe(wall.anchor);
    const MapSegment whole{T_map_anchor * wall.start_keyframe, T_map_anchor * wall.end_keyframe};
    const MapSegment fitted = fitted_to_grid(whole, scene.resolution_m, std::cref(is_occupied), tuning);
    for (const MapSegment& part : supported_parts(fitted, scene.resolution_m, std::cref(is_occupied), tuning))
      scene.walls.push_back(part);
  }
  scene.walls = distinct_walls(std::move(scene.walls), tuning);
}

void add_closures(MapScene& scene, const Backend& backend, StoreyId storey) {
  if (!follows_closures(backend.counters().map_source)) return;
  for (const LoopClosure& closure : backend.closures().values()) {
    if (backend.keyframes().storey(closure.to) != storey) continue;
    const MapSegment ends{backend.T_map_keyframe(closure.from).position(),
                          backend.T_map_keyframe(closure.to).position()};
    (closure.dropped ? scene.dropped_closures : scene.closures).push_back(ends);
  }
}

}  // namespace

MapScene make_map_scene(const Backend& backend, const MapBuilder& map, StoreyId storey) {
  MapScene scene;
  scene.resolution_m = map.config().resolution_m;
  const std::vector<TileIndex> tiles = map.tiles(storey);
  scene.tiles.reserve(tiles.size());
  for (const TileIndex index : tiles) scene.tiles.push_back(map.tile(index));

  const ScanStore& scans = backend.scans();
  scene.scans.reserve(scans.size());
  Pose2 T_map_odom;
  double path_before_m = 0.0;
  bool is_here = false;
  for (const auto& [id, scan] : scans.all()) {
    const bool was_here = std::exchange(is_here, scan.storey == storey);
    const double step_m = scan.path_m - std::exchange(path_before_m, scan.path_m);
    if (!is_here) continue;
    if (was_here) scene.length_m += step_m;
    const bool starts_segment = scan.starts_segment || !was_here;
    const Pose2 T_map_body = backend.T_map_body(id);
    if (starts_segment) T_map_odom = T_map_body * scan.T_odom_body.inverse();
    scene.scans.push_back(
        {T_map_body.position(), T_map_odom * scan.T_odom_body.position(), starts_segment, scan.stamp});
  }
  if (scans.size() > 0) scene.began = scans.all().values().front().stamp;
  if (scans.size() > 0)
    scene.duration = scans.all().values().back().stamp - scans.all().values().front().stamp;
  add_walls(scene, backend, storey, map.config().tuning.walls);
  add_closures(scene, backend, storey);
  return scene;
}

}  // namespace swiftlet
