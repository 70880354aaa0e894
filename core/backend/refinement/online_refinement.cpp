// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/online_refinement.hpp"

#include <algorithm>
#include <utility>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/store/traversal.hpp"
#include "core/geometry/cell_numbers.hpp"

namespace swiftlet {
namespace {

/// What is known of the scan before says nothing of one that begins elsewhere.
bool begins_elsewhere(const StoredScan& scan) { return scan.starts_segment && !scan.odometry_ran_on; }

}  // namespace

void OnlineRefinement::add_scan() {
  const bool is_carried_on =
      !T_graph_refined_.empty() && !begins_elsewhere((*scans_)[T_graph_refined_.end_id()]);
  T_graph_refined_.push_back(is_carried_on ? T_graph_refined_.values().back() : Pose2());
}

void OnlineRefinement::erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals) {
  T_graph_refined_.erase(scans);
  if (traversals_.size() > 0) traversals_.erase(traversals);  // none is filed without refinement
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

/// Whole traversals of one storey, as many as fit; of a newest one that is too long its end.
ScanRange OnlineRefinement::newest_window() const {
  const IdMap<ScanId, StoredScan>& scans = scans_->all();
  const TraversalId newest = newest_traversal();
  ScanRange window = scans_of(newest);
  if (scans.count(window) > tuning_.max_window_scans)
    return {scans.id_at(scans.position(window.end) - tuning_.max_window_scans), window.end};
  const TraversalId oldest = traversal_of(chain_->all().first_id());
  for (TraversalId lowest = newest; lowest > oldest && storey(before(lowest)) == storey(newest);) {
    lowest = before(lowest);
    const ScanRange wider{scans_of(lowest).first, window.end};
    if (scans.count(wider) > tuning_.max_window_scans) break;
    window = wider;
  }
  return window;
}

WindowPoses OnlineRefinement::poses_of(const ScanRange& window, const KeyframePoses& T_map_keyframe,
                                       const KeyframePoses& T_local_keyframe) const {
  const IdMap<ScanId, StoredScan>& scans = scans_->all();
  const std::size_t first = scans.position(window.first);
  WindowPoses poses;
  poses.scans = {scans.id_at(first > 0 ? first - 1 : 0), window.end};
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
                                         const KeyframePoses& T_local_keyframe,
                                         std::span<const DoubtedMotion> doubted) {
  while (traversals_.end_id() < newest_traversal()) file_traversal(traversals_.end_id(), T_map_keyframe);
  const ScanRange window = newest_window();
  WindowPoses poses = poses_of(window, T_map_keyframe, T_local_keyframe);
  poses.doubted = doubted;
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
  for (std::size_t i = 1; i < poses.T_map_body.size(); ++i)
    T_graph_refined_.values()[first + i] = between(poses.T_map_graph[i], poses.T_map_body[i]);
  file_anew(window, T_map_keyframe);
}

void OnlineRefinement::take_offsets(const ScanRange& scans, std::span<const Pose2> T_graph_refined,
                                    const KeyframePoses& T_map_keyframe) {
  const std::size_t first = scans_->all().position(scans.first);
  const auto [taken, next] =
      std::ranges::copy(T_graph_refined, T_graph_refined_.values().subspan(first).begin());
  const std::span<const StoredScan> newer = scans_->all().values().subspan(first + T_graph_refined.size());
  const auto carried_on = std::ranges::find_if(newer, begins_elsewhere) - newer.begin();
  std::fill_n(next, carried_on, T_graph_refined.back());
  file_anew({scans.first, scans_->all().end_id()}, T_map_keyframe);
}

/// The walls of all traversals that have these scans.
void OnlineRefinement::file_anew(const ScanRange& range, const KeyframePoses& T_map_keyframe) {
  const std::span<const StoredScan> scans = scans_->all().values(range);
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
