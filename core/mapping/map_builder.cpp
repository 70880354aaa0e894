// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/mapping/round_robin.hpp"
#include "core/mapping/scan_drawing.hpp"

namespace swiftlet {

struct MapBuilder::State {
  State(const MapConfig& map_config, const SensorModel& sensor)
      : config(map_config),
        max_range_m(sensor.max_range_m),
        drawing(map_config, std::min(map_config.clear_range_m, sensor.max_range_m), sensor.max_range_m) {}

  /// Where a keyframe and the next one stood when the scans in between, which hang on both, were drawn.
  struct Stretch {
    Pose2 T_map_keyframe;
    Pose2 T_map_next;
  };
  [[nodiscard]] static Stretch stretch_now(const Backend& backend, KeyframeId k);
  [[nodiscard]] static ScanId known_end(const Backend& backend) {
    return backend.doubted_since().value_or(backend.scans().all().end_id());
  }
  [[nodiscard]] bool has_moved(const Pose2& drawn, const Pose2& now) const;
  void take_new_keyframes(const Backend& backend);
  void draw_up_to(const Backend& backend, ScanId end);
  void rub_out_from(const Backend& backend, ScanId first);
  [[nodiscard]] KeyframeId first_unsettled(const Backend& backend) const;
  std::size_t follow(const Backend& backend, KeyframeId k);
  void sweep(const Backend& backend);
  void draw(const Backend& backend, ScanId scan);
  void rub_out(const Backend& backend, ScanId scan);
  using Beams = FixedVector<BeamEnd, kMaxBeams>;
  [[nodiscard]] Beams beams_of(const Backend& backend, ScanId scan) const;

  MapConfig config;
  double max_range_m;
  ScanDrawing drawing;
  IdMap<KeyframeId, Stretch> stretches;
  ScanId drawn_end{};            // later scans are not in the map yet
  KeyframeId keyframes_end{};    // of those seen by the last update
  RoundRobin<KeyframeId> swept;  // when all may have moved
};

MapBuilder::State::Stretch MapBuilder::State::stretch_now(const Backend& backend, KeyframeId k) {
  const KeyframeId next = k < backend.keyframes().all().last_id() ? backend.keyframes().all().next(k) : k;
  return {backend.T_map_keyframe(k), backend.T_map_keyframe(next)};
}

bool MapBuilder::State::has_moved(const Pose2& drawn, const Pose2& now) const {
  const Pose2 moved = between(drawn, now);
  const double farthest_m = std::hypot(moved.x_m(), moved.y_m()) + std::abs(moved.yaw_rad()) * max_range_m;
  return farthest_m > config.tuning.drawing.follow_cells * config.resolution_m;
}

void MapBuilder::State::take_new_keyframes(const Backend& backend) {
  const IdMap<KeyframeId, ScanId>& keyframes = backend.keyframes().all();
  for (KeyframeId k = keyframes.at_or_after(stretches.end_id()); k < keyframes.end_id();
       k = keyframes.next(k)) {
    stretches.skip_to(k);
    stretches.push_back(stretch_now(backend, k));
  }
}

/// What has waited is drawn over several updates, too.
void MapBuilder::State::draw_up_to(const Backend& backend, ScanId end) {
  const IdMap<ScanId, StoredScan>& scans = backend.scans().all();
  drawn_end = scans.at_or_after(drawn_end);
  for (std::size_t drawn = 0; drawn_end < end && drawn < config.tuning.drawing.max_returns_moved;
       drawn_end = scans.next(drawn_end)) {
    const KeyframeId k = scans[drawn_end].keyframe;
    if (backend.keyframes().scan_of(k) == drawn_end) stretches[k] = stretch_now(backend, k);
    draw(backend, drawn_end);
    drawn += scans[drawn_end].return_count;
  }
}

void MapBuilder::State::rub_out_from(const Backend& backend, ScanId first) {
  const IdMap<ScanId, StoredScan>& scans = backend.scans().all();
  for (ScanId scan = scans.at_or_after(first); scan < drawn_end; scan = scans.next(scan))
    rub_out(backend, scan);
  drawn_end = std::min(drawn_end, first);
}

/// A new keyframe brings new estimates of those in the frontend's window, and to the scans since the one
/// before it their share of the correction; what lies farther back keeps its pose until the backend moves it.
KeyframeId MapBuilder::State::first_unsettled(const Backend& backend) const {
  const IdMap<KeyframeId, ScanId>& keyframes = backend.keyframes().all();
  if (keyframes.end_id() == keyframes_end) return keyframes_end;
  const std::size_t unsettled = kMaxKeyframeWindow + (keyframes.end_id() - keyframes_end);
  return keyframes.id_at(keyframes.size() - std::min(keyframes.size(), unsettled));
}

/// Draws the scans since keyframe k anew if it or the next one has moved noticeably. Returns how many
/// returns that were.
std::size_t MapBuilder::State::follow(const Backend& backend, KeyframeId k) {
  const Stretch now = stretch_now(backend, k);
  Stretch& drawn = stretches[k];
  if (!has_moved(drawn.T_map_keyframe, now.T_map_keyframe) && !has_moved(drawn.T_map_next, now.T_map_next))
    return 0;
  drawn = now;
  ScanRange scans = backend.keyframes().scans_of({k, k + 1});
  scans.end = std::max(scans.first, std::min(scans.end, drawn_end));
  for (ScanId scan = scans.first; scan < scans.end; scan = backend.scans().all().next(scan))
    draw(backend, scan);
  return backend.scans().return_count(scans);
}

/// A correction of everything is followed over several updates, in turn, so that none takes long.
void MapBuilder::State::sweep(const Backend& backend) {
  for (std::size_t moved = 0; !swept.is_done() && moved < config.tuning.drawing.max_returns_moved;)
    moved += follow(backend, swept.take(stretches));
}

MapBuilder::State::Beams MapBuilder::State::beams_of(const Backend& backend, ScanId scan) const {
  const ScanStore& scans = backend.scans();
  Beams beams;
  for (ScanReturn r : scans.returns(scan)) {
    if (!r.is_hit) r.distance_m = static_cast<float>(max_range_m);
    const bool fits = beams.try_push_back({scans.point_body(r), r.is_hit});
    SWIFTLET_CHECK(fits, "a scan has at most kMaxBeams returns");
  }
  return beams;
}

void MapBuilder::State::draw(const Backend& backend, ScanId scan) {
  const Pose2 T_map_body = backend.T_map_body(scan);
  if (!drawing.needs_drawing(scan, T_map_body)) return;
  const Beams beams = beams_of(backend, scan);
  drawing.draw(scan, T_map_body, {{beams.data(), beams.size()}, backend.scans()[scan].storey});
}

void MapBuilder::State::rub_out(const Backend& backend, ScanId scan) {
  const Beams beams = beams_of(backend, scan);
  drawing.rub_out(scan, {{beams.data(), beams.size()}, backend.scans()[scan].storey});
}

MapBuilder::MapBuilder(const MapConfig& config, const SensorModel& sensor)
    : state_(std::make_unique<State>(config, sensor)) {
  SWIFTLET_CHECK(config.validate().empty(), "the map configuration was validated");
}

MapBuilder::~MapBuilder() = default;

std::vector<TileIndex> MapBuilder::update(const Backend& backend, bool poses_changed,
                                          const ScanRange& refined) {
  State& s = *state_;
  s.take_new_keyframes(backend);
  s.rub_out_from(backend, State::known_end(backend));
  s.draw_up_to(backend, State::known_end(backend));
  const KeyframeId first = s.first_unsettled(backend);
  if (!refined.empty()) {
    const std::span<const StoredScan> scans = backend.scans().all().values(refined);
    const KeyframeId end = std::min(first, scans.back().keyframe + 1);
    for (KeyframeId k = scans.front().keyframe; k < end; k = s.stretches.next(k)) s.follow(backend, k);
  }
  for (KeyframeId k = first; k < s.stretches.end_id(); k = s.stretches.next(k)) s.follow(backend, k);
  s.keyframes_end = s.stretches.end_id();
  if (poses_changed) s.swept.begin(s.stretches);
  s.sweep(backend);
  return s.drawing.store().publish();
}

bool MapBuilder::is_behind(const Backend& backend) const {
  const ScanRange waiting{state_->drawn_end, State::known_end(backend)};
  return waiting.first < waiting.end &&
         backend.scans().return_count(waiting) >= state_->config.tuning.drawing.max_returns_moved;
}

std::vector<TileIndex> MapBuilder::catch_up(const Backend& backend) {
  state_->draw_up_to(backend, State::known_end(backend));
  return state_->drawing.store().publish();
}

std::vector<TileIndex> MapBuilder::settle(const Backend& backend) {
  for (const auto& [scan, stored] : backend.scans().all()) state_->draw(backend, scan);
  state_->drawn_end = backend.scans().all().end_id();
  return state_->drawing.store().publish();
}

void MapBuilder::prune(const Backend& backend, const Pruning& pruning) {
  State& s = *state_;
  s.take_new_keyframes(backend);
  const IdMap<ScanId, StoredScan>& all = backend.scans().all();
  for (const ScanRange& scans : pruning.scans)
    for (ScanId scan = all.at_or_after(scans.first); scan < scans.end; scan = all.next(scan))
      s.rub_out(backend, scan);
  s.drawing.erase(pruning.scans);
  s.swept.erase(pruning.keyframes, s.stretches);
  s.stretches.erase(pruning.keyframes);
}

MapTile MapBuilder::tile(TileIndex index) const { return state_->drawing.store().tile(index); }

std::vector<TileIndex> MapBuilder::tiles() const { return state_->drawing.store().tiles(); }

std::vector<TileIndex> MapBuilder::tiles(StoreyId storey) const {
  std::vector<TileIndex> found = tiles();
  std::erase_if(found, [&](const TileIndex& index) { return index.storey != storey; });
  return found;
}

std::vector<StoreyId> MapBuilder::storeys() const {
  std::set<StoreyId> found{StoreyId{}};
  for (const TileIndex& index : tiles()) found.insert(index.storey);
  return {found.begin(), found.end()};
}

const MapConfig& MapBuilder::config() const { return state_->config; }

}  // namespace swiftlet
