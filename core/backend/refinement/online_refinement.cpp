// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/online_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/store/traversal.hpp"
#include "core/geometry/cell_numbers.hpp"

namespace swiftlet {
void OnlineRefinement::add_scan() {
  const StoredScan& scan = (*scans_)[T_graph_refined_.end_id()];
  const bool is_carried_on = !T_graph_refined_.empty() && (!scan.starts_segment || scan.odometry_ran_on);
  T_graph_refined_.push_back(is_carried_on ? T_graph_refined_.values().back() : Pose2());
}

void OnlineRefinement::queue_around(KeyframeId place) {
  const TraversalId traversal = traversal_of(place);
  const bool waits = std::any_of(waiting_.begin(), waiting_.end(), [&](TraversalId w) {
    return traversals_between(w, traversal) < tuning_.same_place_traversals;
  });
  if (waits) return;
  if (waiting_.size() == tuning_.max_places_waiting) waiting_.pop_front();
  waiting_.push_back(traversal);
}

void OnlineRefinement::erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals) {
  T_graph_refined_.erase(scans);
  if (traversals_.size() > 0) traversals_.erase(traversals);  // none is filed without refinement
  std::erase_if(waiting_, [&](TraversalId traversal) { return traversals.contains(traversal); });
}

void OnlineRefinement::follow(const KeyframePoses& T_map_keyframe) {
  for (const TraversalId traversal : traversals_.filed({TraversalId{}, traversals_.end_id()}))
    traversals_.move(traversal, T_map_body(traversals_[traversal].reference, T_map_keyframe));
}

Pose2 OnlineRefinement::T_map_body(ScanId scan, const KeyframePoses& T_map_keyframe) const {
  return refined(scan, chain_->T_w_body(scan, T_map_keyframe));
}

TraversalId OnlineRefinement::newest_traversal() const { return traversal_of(chain_->all().last_id()); }

TraversalId OnlineRefinement::before(TraversalId traversal) const {
  return traversal_of(chain_->all().previous(keyframes_of(traversal).first));
}

TraversalId OnlineRefinement::after(TraversalId traversal) const {
  return traversal_of(chain_->all().at_or_after(keyframes_of(traversal).end));
}

/// How far apart two traversals are, counting those that were not pruned.
std::size_t OnlineRefinement::traversals_between(TraversalId a, TraversalId b) const {
  return chain_->all().count({keyframes_of(std::min(a, b)).first, keyframes_of(std::max(a, b)).first}) /
         kKeyframesPerTraversal;
}

/// Whole traversals of one storey, as many as fit on both sides of the middle one; of a traversal that is too
/// long its end.
ScanRange OnlineRefinement::window_around(TraversalId traversal) const {
  const IdMap<ScanId, StoredScan>& scans = scans_->all();
  ScanRange window = scans_of(traversal);
  if (scans.count(window) > tuning_.max_window_scans)
    return {scans.id_at(scans.position(window.end) - tuning_.max_window_scans), window.end};
  const TraversalId oldest = traversal_of(chain_->all().first_id());
  TraversalId lowest = traversal;
  TraversalId highest = traversal;
  for (bool grows = true; grows;) {
    grows = false;
    if (lowest > oldest && storey(before(lowest)) == storey(traversal) &&
        scans.count({scans_of(before(lowest)).first, window.end}) <= tuning_.max_window_scans) {
      lowest = before(lowest);
      window.first = scans_of(lowest).first;
      grows = true;
    }
    if (highest < newest_traversal() && storey(after(highest)) == storey(traversal) &&
        scans.count({window.first, scans_of(after(highest)).end}) <= tuning_.max_window_scans) {
      highest = after(highest);
      window.end = scans_of(highest).end;
      grows = true;
    }
  }
  return window;
}

/// Every other turn is the newest scans'; the rest is shared by places that wait and the sweep.
ScanRange OnlineRefinement::next_window() {
  const std::uint32_t turn = turn_++ % 4;
  if (turn % 2 == 0) return window_around(newest_traversal());
  if (turn == 1 && !waiting_.empty()) {
    const TraversalId place = waiting_.front();
    waiting_.pop_front();
    return window_around(place);
  }
  if (swept_ >= scans_of(newest_traversal()).first) swept_ = scans_->all().first_id();
  swept_ = scans_->all().at_or_after(swept_);
  const ScanRange window = window_around(traversal_of((*scans_)[swept_]));
  swept_ = std::max(window.end, swept_ + 1);
  return window;
}

WindowPoses OnlineRefinement::poses_of(const ScanRange& window, const KeyframePoses& T_map_keyframe,
                                       const KeyframePoses& T_local_keyframe) const {
  const IdMap<ScanId, StoredScan>& scans = scans_->all();
  const std::size_t first = scans.position(window.first);
  WindowPoses poses;
  poses.scans.first = scans.id_at(first > 0 ? first - 1 : 0);
  poses.scans.end = std::min(scans.at_or_after(window.end) + 1, scans.end_id());
  poses.T_map_graph = chain_->T_w_bodies(poses.scans, T_map_keyframe);
  poses.T_local_body = chain_->T_w_bodies(poses.scans, T_local_keyframe);
  const std::span<const Pose2> T_graph_refined = T_graph_refined_.values(poses.scans);
  for (std::size_t i = 0; i < T_graph_refined.size(); ++i)
    poses.T_map_body.push_back(poses.T_map_graph[i] * T_graph_refined[i]);
  return poses;
}

/// What traversals outside of the window drew where its returns lie.
std::vector<TraversalPoint> OnlineRefinement::walls_around(const ScanRange& window, const WindowPoses& poses,
                                                           const KeyframePoses& T_map_keyframe) const {
  std::vector<Point2> places_map;
  std::size_t number = 0;
  const std::span<const StoredScan> scans = scans_->all().values(window);
  const Pose2* T_map_scan = &poses.T_map_body[scans_->all().count({poses.scans.first, window.first})];
  for (const StoredScan& scan : scans) {
    for (const ScanReturn& beam : scans_->returns(scan))
      if (beam.is_hit && number++ % tuning_.returns_per_place == 0)
        places_map.push_back(*T_map_scan * scans_->point_body(beam));
    ++T_map_scan;
  }
  const IdRange<TraversalId> in_window{traversal_of(scans.front()), traversal_of(scans.back()) + 1};
  std::vector<TraversalPoint> points;
  for (const TraversalId traversal : traversals_.near(places_map, scans.front().storey, in_window)) {
    const Pose2 T_map_reference = T_map_body(traversals_[traversal].reference, T_map_keyframe);
    for (const Point2& p_reference : traversals_[traversal].points_reference)
      points.push_back({T_map_reference * p_reference, index_of(traversal)});
  }
  return points;
}

Result<ScanRange> OnlineRefinement::step(const KeyframePoses& T_map_keyframe,
                                         const KeyframePoses& T_local_keyframe) {
  while (traversals_.end_id() < newest_traversal()) file_traversal(traversals_.end_id(), T_map_keyframe);
  const ScanRange window = next_window();
  WindowPoses poses = poses_of(window, T_map_keyframe, T_local_keyframe);
  const Result<WindowReport> report =
      window_refinement_.refine(window, walls_around(window, poses, T_map_keyframe), poses);
  if (!report) return report.error();
  last_window_ = *report;
  if (!report->accepted) {
    ++windows_refused_;
    return ScanRange{};
  }
  ++windows_refined_;
  take(window, poses, T_map_keyframe);
  return window;
}

void OnlineRefinement::take(const ScanRange& window, const WindowPoses& poses,
                            const KeyframePoses& T_map_keyframe) {
  const std::size_t first = scans_->all().position(poses.scans.first);
  const std::size_t moved = scans_->all().count({poses.scans.first, window.end});
  for (std::size_t i = 1; i < moved; ++i)
    T_graph_refined_.values()[first + i] = between(poses.T_map_graph[i], poses.T_map_body[i]);
  const std::span<const StoredScan> scans = scans_->all().values(window);
  for (const TraversalId traversal :
       traversals_.filed({traversal_of(scans.front()), traversal_of(scans.back()) + 1}))
    file_traversal(traversal, T_map_keyframe);
}

void OnlineRefinement::file_traversal(TraversalId traversal, const KeyframePoses& T_map_keyframe) {
  const ScanRange range = scans_of(traversal);
  const std::span<const StoredScan> scans = scans_->all().values(range);
  const std::size_t first = scans_->all().position(range.first);
  TraversalWalls walls;
  walls.reference = scans_->all().id_at(first + scans.size() / 2);
  walls.storey = storey(traversal);
  const Pose2 T_map_reference = T_map_body(walls.reference, T_map_keyframe);
  const Pose2 T_reference_map = T_map_reference.inverse();
  const std::size_t every = 1 + scans.size() / tuning_.max_traversal_scans;
  const std::vector<Pose2> T_map_graph = chain_->T_w_bodies(range, T_map_keyframe, every);
  CellNumbers cells(refinement_tuning_.thinning_cell_m);
  cells.reset(std::min<std::size_t>(scans_->return_count(range), tuning_.max_traversal_scans * kMaxBeams));
  for (std::size_t i = 0; i < scans.size(); i += every) {
    if (scans[i].storey != walls.storey) continue;
    const ScanId id = scans_->all().id_at(first + i);
    const Pose2 T_reference_body = T_reference_map * refined(id, T_map_graph[i / every]);
    const std::span<const ScanReturn> beams = scans_->returns(scans[i]);
    for (const ScanReturn& beam : beams) {
      if (!beam.is_hit || is_held_out(id, beam.beam, refinement_tuning_)) continue;
      const Point2 p = T_reference_body * scans_->point_body(beam);
      if (cells.is_first(p)) walls.points_reference.push_back(p);
    }
  }
  traversals_.set(traversal, std::move(walls), T_map_reference);
}

}  // namespace swiftlet
