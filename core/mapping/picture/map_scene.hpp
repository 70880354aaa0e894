// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/mapping/map_tile.hpp"

namespace swiftlet {

class Backend;
class MapBuilder;

struct MapSegment {
  Point2 start_map;
  Point2 end_map;
};

/// One scan of the run.
struct ScenePoint {
  Point2 corrected_map;
  Point2 odometry_map;          ///< dead reckoning, begun at the corrected pose of its segment's first scan
  bool starts_segment = false;  ///< dead reckoning does not lead here from the scan before on this storey
  HostTime stamp{};
};

/// What a picture of one storey of a run shows, as plain values. All points are in the map frame.
struct MapScene {
  double resolution_m = 0.05;
  std::vector<MapTile> tiles;
  std::vector<ScenePoint> scans;     ///< in order of time
  std::vector<MapSegment> walls;     ///< as far as the grid bears them out
  std::vector<MapSegment> closures;  ///< accepted, from keyframe to keyframe; none where the map
                                     ///< does not follow them
  std::vector<MapSegment> dropped_closures;
  std::string title;      ///< of the run; empty: it has none
  HostTime began{};       ///< stamp of the run's first scan, on whatever storey
  Duration duration{0};   ///< from the run's first scan to its last
  double length_m = 0.0;  ///< travelled on the storey, by dead reckoning, with what was pruned
};

/// The present state of a run on a storey, without a title. Allocates.
[[nodiscard]] MapScene make_map_scene(const Backend& backend, const MapBuilder& map, StoreyId storey = {});

}  // namespace swiftlet
