// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/mapping/round_robin.hpp"
#include "core/mapping/scan_drawing.hpp"

namespace swiftlet {
namespace {

constexpr double kFollowsWithinCells = 0.5;
constexpr std::size_t kMaxReturnsMoved = 4000;  // in one update: about a millisecond

}  // namespace

struct MapBuilder::State {
  State(const MapConfig& map_config, const SensorModel& sensor)
      : config(map_config),
        max_range_m(static_cast<float>(sensor.max_range_m)),
        clear_range_m(std::min(map_config.clear_range_m, sensor.max_range_m)),
        drawing(map_config, clear_range_m) {}

  /// The scans since a keyframe, and where it and the next one stood when they were drawn: those in between
  /// hang on both.
  struct Stretch {
    ScanIndex first = 0;
    Pose2 T_map_keyframe;
    Pose2 T_map_next;
  };
  [[nodiscard]] Stretch stretch_now(const Backend& backend, std::size_t k) const;
  [[nodiscard]] ScanIndex end_of(std::size_t k, const Backend& backend) const;
  [[nodiscard]] bool has_moved(const Pose2& drawn, const Pose2& now) const;
  void take_new_scans(const Backend& backend);
  [[nodiscard]] std::size_t first_unsettled(const Backend& backend) const;
  std::size_t follow(const Backend& backend, std::size_t k);
  void sweep(const Backend& backend);
  void draw(const Backend& backend, ScanIndex scan);
  using Beams = FixedVector<BeamEnd, kMaxBeams>;
  [[nodiscard]] Beams beams_of(const Backend& backend, ScanIndex scan) const;

  MapConfig config;
  float max_range_m;
  double clear_range_m;
  ScanDrawing drawing;
  std::vector<Stretch> stretches;  // by keyframe
  ScanIndex scans_seen = 0;
  std::size_t keyframes_seen = 0;  // as of the last update
  RoundRobin swept;                // keyframes, when all may have moved
};

MapBuilder::State::Stretch MapBuilder::State::stretch_now(const Backend& backend, std::size_t k) const {
  const std::size_t next = std::min(k + 1, backend.keyframe_count() - 1);
  return {stretches[k].first, backend.T_map_keyframe(static_cast<KeyframeId>(k)),
          backend.T_map_keyframe(static_cast<KeyframeId>(next))};
}

ScanIndex MapBuilder::State::end_of(std::size_t k, const Backend& backend) const {
  return k + 1 < stretches.size() ? stretches[k + 1].first : static_cast<ScanIndex>(backend.scans().size());
}

bool MapBuilder::State::has_moved(const Pose2& drawn, const Pose2& now) const {
  const Pose2 moved = between(drawn, now);
  const double farthest_m = std::hypot(moved.x_m(), moved.y_m()) + std::abs(moved.yaw_rad()) * clear_range_m;
  return farthest_m > kFollowsWithinCells * config.resolution_m;
}

void MapBuilder::State::take_new_scans(const Backend& backend) {
  const ScanStore& scans = backend.scans();
  for (; scans_seen < scans.size(); ++scans_seen) {
    while (stretches.size() <= index_of(scans[scans_seen].keyframe)) {
      stretches.emplace_back().first = scans_seen;
      stretches.back() = stretch_now(backend, stretches.size() - 1);
    }
    draw(backend, scans_seen);
  }
}

/// A new keyframe brings new estimates of those in the frontend's window, and to the scans since the one
/// before it their share of the correction; what lies farther back keeps its pose until the backend says so.
std::size_t MapBuilder::State::first_unsettled(const Backend& backend) const {
  const std::size_t keyframes = backend.keyframe_count();
  if (keyframes == keyframes_seen) return keyframes;
  return keyframes - std::min(keyframes, kMaxKeyframeWindow + keyframes - keyframes_seen);
}

/// Draws the scans since keyframe k anew if it or the next one has moved noticeably. Returns how many
/// returns that were.
std::size_t MapBuilder::State::follow(const Backend& backend, std::size_t k) {
  const Stretch now = stretch_now(backend, k);
  Stretch& drawn = stretches[k];
  if (!has_moved(drawn.T_map_keyframe, now.T_map_keyframe) && !has_moved(drawn.T_map_next, now.T_map_next))
    return 0;
  drawn = now;
  std::size_t returns = 0;
  for (ScanIndex scan = now.first; scan < end_of(k, backend); ++scan) {
    draw(backend, scan);
    returns += backend.scans().returns(scan).size();
  }
  return returns;
}

/// A correction of everything is followed over several updates, in turn, so that none takes long.
void MapBuilder::State::sweep(const Backend& backend) {
  for (std::size_t moved = 0; !swept.is_done() && moved < kMaxReturnsMoved;)
    moved += follow(backend, swept.take(stretches.size()));
}

MapBuilder::State::Beams MapBuilder::State::beams_of(const Backend& backend, ScanIndex scan) const {
  const ScanStore& scans = backend.scans();
  Beams beams;
  for (ScanReturn r : scans.returns(scan)) {
    if (!r.is_hit) r.distance_m = max_range_m;
    const bool fits = beams.try_push_back({scans.point_body(r), r.is_hit});
    SWIFTLET_CHECK(fits, "a scan has at most kMaxBeams returns");
  }
  return beams;
}

void MapBuilder::State::draw(const Backend& backend, ScanIndex scan) {
  const Pose2 T_map_body = backend.T_map_body(scan);
  if (!drawing.needs_drawing(scan, T_map_body)) return;
  const Beams beams = beams_of(backend, scan);
  drawing.draw(scan, T_map_body, std::span<const BeamEnd>(beams.data(), beams.size()));
}

MapBuilder::MapBuilder(const MapConfig& config, const SensorModel& sensor)
    : state_(std::make_unique<State>(config, sensor)) {
  SWIFTLET_CHECK(config.validate().empty(), "the map configuration was validated");
}

MapBuilder::~MapBuilder() = default;

std::vector<TileIndex> MapBuilder::update(const Backend& backend, bool poses_changed, ScanRange refined) {
  State& s = *state_;
  s.take_new_scans(backend);
  const std::size_t first = s.first_unsettled(backend);
  if (refined.size() > 0) {
    const std::size_t last = index_of(backend.scans()[refined.end - 1].keyframe);
    for (std::size_t k = index_of(backend.scans()[refined.first].keyframe); k < std::min(first, last + 1);
         ++k)
      s.follow(backend, k);
  }
  for (std::size_t k = first; k < s.stretches.size(); ++k) s.follow(backend, k);
  s.keyframes_seen = backend.keyframe_count();
  if (poses_changed) s.swept.begin(s.stretches.size());
  s.sweep(backend);
  return s.drawing.store().publish();
}

std::vector<TileIndex> MapBuilder::settle(const Backend& backend) {
  state_->take_new_scans(backend);
  for (ScanIndex scan = 0; scan < backend.scans().size(); ++scan) state_->draw(backend, scan);
  return state_->drawing.store().publish();
}

void MapBuilder::prune(const Backend& backend, const Pruning& pruning) {
  State& s = *state_;
  s.take_new_scans(backend);
  for (const ScanRange& scans : pruning.scans.ranges()) {
    for (ScanIndex scan = scans.first; scan < scans.end; ++scan) {
      const State::Beams beams = s.beams_of(backend, scan);
      s.drawing.rub_out(scan, std::span<const BeamEnd>(beams.data(), beams.size()));
    }
  }
  s.drawing.remove(pruning.scans);
  s.swept.remove(pruning.keyframes, s.stretches.size());
  pruning.keyframes.apply(s.stretches);
  for (State::Stretch& stretch : s.stretches) stretch.first = pruning.scans.new_index(stretch.first);
  s.scans_seen -= pruning.scans.size();
  s.keyframes_seen -= pruning.keyframes.size();
}

MapTile MapBuilder::tile(TileIndex index) const { return state_->drawing.store().tile(index); }

std::vector<TileIndex> MapBuilder::tiles() const { return state_->drawing.store().tiles(); }

const MapConfig& MapBuilder::config() const { return state_->config; }

}  // namespace swiftlet
