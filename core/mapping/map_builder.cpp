// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_builder.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/mapping/scan_drawing.hpp"

namespace swiftlet {

struct MapBuilder::State {
  State(const MapConfig& map_config, const SensorModel& sensor)
      : config(map_config),
        max_range_m(static_cast<float>(sensor.max_range_m)),
        drawing(map_config, std::min(map_config.clear_range_m, sensor.max_range_m)) {}

  [[nodiscard]] ScanIndex first_unsettled(const Backend& backend) const;
  void draw(const Backend& backend, ScanIndex scan);

  MapConfig config;
  float max_range_m;
  ScanDrawing drawing;
  ScanIndex drawn_scans = 0;       ///< scans before this one have been drawn
  std::size_t keyframes_seen = 0;  ///< as of the last update
};

/// A new keyframe brings new estimates of those in the frontend's window, and to the scans since the one
/// before it their share of the correction; what lies farther back keeps its pose until the backend says so.
ScanIndex MapBuilder::State::first_unsettled(const Backend& backend) const {
  const std::size_t keyframes = backend.keyframe_count();
  if (keyframes == keyframes_seen) return drawn_scans;
  const std::size_t new_keyframes = keyframes - keyframes_seen;
  const std::size_t first_changed = keyframes - std::min(keyframes, kMaxKeyframeWindow + new_keyframes);
  const ScanStore& scans = backend.scans();
  ScanIndex scan = drawn_scans;
  while (scan > 0 && index_of(scans[scan - 1].keyframe) >= first_changed) --scan;
  return scan;
}

void MapBuilder::State::draw(const Backend& backend, ScanIndex scan) {
  const Pose2 T_map_body = backend.T_map_body(scan);
  if (!drawing.needs_drawing(scan, T_map_body)) return;
  const ScanStore& scans = backend.scans();
  FixedVector<BeamEnd, kMaxBeams> beams;
  for (ScanReturn r : scans.returns(scan)) {
    if (!r.is_hit) r.distance_m = max_range_m;
    const bool fits = beams.try_push_back({scans.point_body(r), r.is_hit});
    SWIFTLET_CHECK(fits, "a scan has at most kMaxBeams returns");
  }
  drawing.draw(scan, T_map_body, std::span<const BeamEnd>(beams.data(), beams.size()));
}

MapBuilder::MapBuilder(const MapConfig& config, const SensorModel& sensor)
    : state_(std::make_unique<State>(config, sensor)) {
  SWIFTLET_CHECK(config.validate().empty(), "the map configuration was validated");
}

MapBuilder::~MapBuilder() = default;

std::vector<TileIndex> MapBuilder::update(const Backend& backend, bool poses_changed, ScanRange refined) {
  const auto scan_count = static_cast<ScanIndex>(backend.scans().size());
  const ScanIndex first = poses_changed ? 0 : state_->first_unsettled(backend);
  for (ScanIndex scan = refined.first; scan < std::min(refined.end, first); ++scan)
    state_->draw(backend, scan);
  for (ScanIndex scan = first; scan < scan_count; ++scan) state_->draw(backend, scan);
  state_->drawn_scans = scan_count;
  state_->keyframes_seen = backend.keyframe_count();
  return state_->drawing.store().publish();
}

MapTile MapBuilder::tile(TileIndex index) const { return state_->drawing.store().tile(index); }

std::vector<TileIndex> MapBuilder::tiles() const { return state_->drawing.store().tiles(); }

const MapConfig& MapBuilder::config() const { return state_->config; }

}  // namespace swiftlet
