// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "daemon/publish/publisher.hpp"

namespace swiftlet {

/// Keeps all that is published, and a consumer's copy of the map.
class RecordingPublisher final : public Publisher {
 public:
  void publish_pose(const PoseUpdate& pose) override {
    poses.push_back(pose);
    if (on_pose) on_pose();
  }
  void publish_tile(HostTime, const MapTile& tile, double) override {
    tiles.push_back(tile);
    MapTile& kept = newest.try_emplace(tile.index, tile).first->second;
    if (tile.version >= kept.version) kept = tile;
  }
  void publish_map(HostTime, const MapSummary& map) override { maps.push_back(map); }
  void publish_walls(HostTime, std::span<const WallInMap> all) override {
    walls.assign(all.begin(), all.end());
  }
  void publish_closure(HostTime, const ClosureUpdate& closure) override { closures.push_back(closure); }
  void publish_event(HostTime, const VehicleEvent& event) override { events.push_back(event.kind); }
  void publish_status(HostTime, const DaemonStatus& status) override { statuses.push_back(status); }

  std::vector<PoseUpdate> poses;
  std::vector<MapTile> tiles;
  std::map<TileIndex, MapTile> newest;
  std::vector<MapSummary> maps;
  std::vector<WallInMap> walls;  ///< as published last
  std::vector<ClosureUpdate> closures;
  std::vector<VehicleEvent::Kind> events;
  std::vector<DaemonStatus> statuses;
  std::function<void()> on_pose;  ///< called after each pose, if set
};

}  // namespace swiftlet
