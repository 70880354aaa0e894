// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pruning/pruning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/backend/store/traversal.hpp"
#include "core/geometry/grid.hpp"
#include "core/geometry/pose_residual.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

using Tile = std::tuple<StoreyId, std::int32_t, std::int32_t>;

struct SeenTile {
  std::size_t number = 0;
  double share = 0.0;  // of the traversal's returns
};

struct Traversal {
  IdRange<KeyframeId> keyframes;
  ScanRange scans;
  StoreyId storey{};  // in the middle
  Point2 middle_map;
  double path_m = 0.0;
  std::vector<SeenTile> tiles;
  bool stays_for_good = false;  // one of the oldest where it was
  bool is_redundant = false;    // neither that nor one of the newest
};

/// Which traversals saw which tiles.
class Coverage {
 public:
  Coverage(const ScanStore& scans, const KeyframeChain& chain, const KeyframePoses& T_map_keyframe,
           std::span<const KeyframeId> anchors, const BackendTuning& tuning)
      : scans_(scans),
        chain_(chain),
        T_map_keyframe_(T_map_keyframe),
        tuning_(tuning.pruning),
        tile_m_(tuning.index.tile_m) {
    for (std::size_t k = 0; k + kKeyframesPerTraversal <= chain.size(); k += kKeyframesPerTraversal)
      traversals_.push_back(make_traversal(traversal_of(chain.all().id_at(k))));
    judge();
    if (!traversals_.empty()) keep(traversals_.front());  // it holds the map's frame
    for (const KeyframeId anchor : anchors)
      keep(traversals_[chain.all().position(anchor) / kKeyframesPerTraversal]);
  }

  [[nodiscard]] const std::vector<Traversal>& traversals() const { return traversals_; }
  [[nodiscard]] std::optional<KeyframeId> anchor_of(const Traversal& traversal, double other_time_m) const;

 private:
  [[nodiscard]] Tile tile_of(StoreyId storey, const Point2& p_map) const {
    return {storey, floor_to_int(p_map.x_m / tile_m_), floor_to_int(p_map.y_m / tile_m_)};
  }
  [[nodiscard]] Traversal make_traversal(TraversalId id);
  void judge();
  static void keep(Traversal& traversal) {
    traversal.stays_for_good = true;
    traversal.is_redundant = false;
  }

  const ScanStore& scans_;
  const KeyframeChain& chain_;
  const KeyframePoses& T_map_keyframe_;
  const PruningTuning& tuning_;
  double tile_m_;  // side of the tiles in which traversals are counted
  std::vector<Traversal> traversals_;
  std::map<Tile, std::size_t> number_of_;
  std::vector<std::size_t> traversals_in_;  // of each tile
};

Traversal Coverage::make_traversal(TraversalId id) {
  Traversal traversal;
  traversal.keyframes = keyframes_of(id);
  traversal.scans = chain_.scans_of(traversal.keyframes);
  const KeyframeId middle = traversal.keyframes.first + kKeyframesPerTraversal / 2;
  traversal.middle_map = T_map_keyframe_[middle].position();
  traversal.storey = chain_.storey(middle);
  traversal.path_m = chain_.path_m(middle);
  std::map<Tile, std::size_t> returns_in;
  const std::size_t every = 1 + scans_.return_count(traversal.scans) / tuning_.returns_per_traversal;
  const std::vector<Pose2> T_map_body = chain_.T_w_bodies(traversal.scans, T_map_keyframe_);
  const std::span<const StoredScan> scans = scans_.all().values(traversal.scans);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (const ScanReturn& beam : scans_.returns(scans[i])) {
      if ((i + beam.beam) % every != 0 || !beam.is_hit) continue;  // each beam in its turn
      const Point2 p = T_map_body[i] * scans_.point_body(beam);
      ++returns_in[tile_of(scans[i].storey, p)];
    }
  }
  if (returns_in.empty())  // all walls are out of reach
    ++returns_in[tile_of(traversal.storey, traversal.middle_map)];
  std::size_t all = 0;
  for (const auto& [tile, count] : returns_in) all += count;
  for (const auto& [tile, count] : returns_in) {
    const std::size_t at = number_of_.emplace(tile, number_of_.size()).first->second;
    traversal.tiles.push_back({at, static_cast<double>(count) / static_cast<double>(all)});
  }
  traversals_in_.resize(number_of_.size());
  for (const SeenTile& tile : traversal.tiles) ++traversals_in_[tile.number];
  return traversal;
}

void Coverage::judge() {
  std::vector<std::size_t> before(traversals_in_.size(), 0);  // the present traversal, in each tile
  for (Traversal& traversal : traversals_) {
    double old = 0.0;  // share of its returns where enough traversals were before it
    double new_and_old = 0.0;
    for (const SeenTile& tile : traversal.tiles) {
      const std::size_t after = traversals_in_[tile.number] - before[tile.number] - 1;
      const bool has_older = before[tile.number] >= tuning_.kept_per_tile;
      old += has_older ? tile.share : 0.0;
      new_and_old += has_older && after >= tuning_.kept_per_tile ? tile.share : 0.0;
      ++before[tile.number];
    }
    traversal.stays_for_good = old < tuning_.share_of_returns;
    traversal.is_redundant = new_and_old >= tuning_.share_of_returns;
  }
}

std::optional<KeyframeId> Coverage::anchor_of(const Traversal& traversal, double other_time_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  std::optional<KeyframeId> anchor;
  for (const Traversal& other : traversals_) {
    if (!other.stays_for_good || other.storey != traversal.storey) continue;
    if (std::abs(other.path_m - traversal.path_m) < other_time_m) continue;
    const double off_m = distance_m(traversal.middle_map, other.middle_map);
    if (off_m >= nearest_m) continue;
    nearest_m = off_m;
    anchor = other.keyframes.first + kKeyframesPerTraversal / 2;
  }
  return anchor;
}

}  // namespace

void Pruning::add(const PrunedTraversal& traversal, const ScanStore& store) {
  traversals.push_back(traversal);
  keyframes.add(traversal.keyframes);
  scans.add(traversal.scans);
  ids.add(traversal_of(traversal.keyframes.first));
  scan_count += store.all().count(traversal.scans);
  seeing_count += store.seeing(traversal.scans);
}

Pruning Pruner::plan(const KeyframePoses& T_map_keyframe, KeyframeId first_recent,
                     std::size_t scans_wanted) const {
  const Coverage coverage(*scans_, *chain_, T_map_keyframe, anchors_, config_->tuning);
  const std::vector<Traversal>& traversals = coverage.traversals();
  std::vector<std::optional<KeyframeId>> anchor_of(traversals.size());  // of those that can go
  for (std::size_t p = 0; p < traversals.size(); ++p)
    if (traversals[p].is_redundant && traversals[p].keyframes.end <= first_recent)
      anchor_of[p] = coverage.anchor_of(traversals[p], config_->min_travel_between_m);
  Pruning pruning;
  for (std::size_t p = 0; p < traversals.size() && pruning.seeing_count < scans_wanted;) {
    std::size_t end = p;
    while (end < traversals.size() && anchor_of[end]) ++end;
    const bool widens_a_hole = end > p && ((*scans_)[traversals[p].scans.first].starts_segment ||
                                           (*scans_)[traversals[end - 1].scans.end].starts_segment);
    if (end - p >= config_->tuning.pruning.min_run || widens_a_hole) {
      for (std::size_t k = p; k < end && pruning.seeing_count < scans_wanted; ++k)
        pruning.add({traversals[k].keyframes, traversals[k].scans, *anchor_of[k]}, *scans_);
    }
    p = end + 1;
  }
  return pruning;
}

Pruning Pruner::next(const KeyframePoses& T_map_keyframe, KeyframeId first_in_use, bool may_wait) {
  const auto at_a_time =
      static_cast<std::size_t>(config_->tuning.pruning.share_at_a_time * config_->max_scans);
  if (scans_->seeing() < due_at_ + (may_wait ? at_a_time : 0) || chain_->size() == 0) return {};
  Pruning pruning =
      plan(T_map_keyframe, first_recent(first_in_use), scans_->seeing() - max_scans() + at_a_time);
  // Where little can be spared, there is nothing to be gained by asking at every step.
  due_at_ = std::max(max_scans(), scans_->seeing() - pruning.seeing_count + at_a_time);
  return pruning;
}

void Pruner::keep_anchors(const Pruning& pruning) {
  for (const PrunedTraversal& traversal : pruning.traversals) anchors_.push_back(traversal.anchor);
  std::sort(anchors_.begin(), anchors_.end());
  anchors_.erase(std::unique(anchors_.begin(), anchors_.end()), anchors_.end());
}

/// The first keyframe that the frontend may still change, or that an open submap or a multiscan uses.
KeyframeId Pruner::first_recent(KeyframeId first_in_use) const {
  const IdMap<KeyframeId, ScanId>& keyframes = chain_->all();
  const double recent_m = chain_->path_m(keyframes.last_id()) -
                          2.0 * std::max(config_->submap_length_m, config_->multiscan_length_m);
  std::size_t first = chain_->size() - std::min(chain_->size(), 2 * kMaxKeyframeWindow);
  while (first > 0 && chain_->path_m(keyframes.id_at(first)) > recent_m) --first;
  return std::min(keyframes.id_at(first), first_in_use);
}

std::vector<RelativePoseFactor<KeyframeId>> ties_around(const Pruning& pruning, const ScanStore& scans,
                                                        const PoseGraph& graph, const BackendTuning& tuning) {
  const KeyframePoses& T_map_keyframe = graph.T_map_keyframe;
  const SlipNoise slip{tuning.confidence.slip_along_m2_per_m, tuning.confidence.slip_yaw_rad2_per_m};
  const OdometrySigma least{tuning.pruning.tie_sigma_m, tuning.pruning.tie_sigma_rad};
  std::vector<RelativePoseFactor<KeyframeId>> ties;
  const auto needs_tie = [&](KeyframeId end, ScanId behind) {
    const bool is_held_by_motion = !scans[behind].starts_segment || scans[behind].odometry_ran_on;
    return is_held_by_motion && !pruning.keyframes.contains(end);
  };
  for (const PrunedTraversal& traversal : pruning.traversals) {
    const KeyframeId before = T_map_keyframe.previous(traversal.keyframes.first);
    const KeyframeId behind = T_map_keyframe.at_or_after(traversal.keyframes.end);
    const bool ties_before = needs_tie(before, traversal.scans.first);
    const bool ties_behind = needs_tie(behind, traversal.scans.end);
    if (!ties_before && !ties_behind) continue;
    const auto known = cautious_relative_covariances(graph, traversal.anchor, tuning.covariance, slip);
    const auto tie = [&](KeyframeId end) {
      RelativePoseFactor<KeyframeId> c;
      c.from = traversal.anchor;
      c.to = end;
      c.T_from_to = between(T_map_keyframe[c.from], T_map_keyframe[end]);
      Eigen::Matrix3d covariance = known[end];
      covariance.diagonal() = covariance.diagonal().cwiseMax(least.covariance().diagonal());
      c.information = residual_information(c.T_from_to, covariance);
      c.is_closure = true;
      ties.push_back(c);
    };
    if (ties_before) tie(before);
    if (ties_behind) tie(behind);
  }
  return ties;
}

}  // namespace swiftlet
