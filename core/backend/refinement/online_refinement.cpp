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
namespace {

constexpr double kThinningM = 0.08;  // as in a WallMap
constexpr ScanIndex kMaxScansPerTraversal = 100;
constexpr std::size_t kReturnsPerPlace = 5;        // neighbours lie in the same tile
constexpr std::uint32_t kSamePlaceTraversals = 3;  // one window serves closures this close

}  // namespace

void OnlineRefinement::add_scan() {
  const StoredScan& scan = (*scans_)[static_cast<ScanIndex>(T_graph_refined_.size())];
  const bool is_carried_on = !T_graph_refined_.empty() && (!scan.starts_segment || scan.odometry_ran_on);
  T_graph_refined_.push_back(is_carried_on ? T_graph_refined_.back() : Pose2());
}

void OnlineRefinement::queue_around(KeyframeId place) {
  const std::uint32_t traversal = index_of(place) / kKeyframesPerTraversal;
  const bool waits = std::any_of(waiting_.begin(), waiting_.end(), [&](std::uint32_t w) {
    return std::max(w, traversal) - std::min(w, traversal) < kSamePlaceTraversals;
  });
  if (waits) return;
  if (waiting_.size() == kMaxPlacesWaiting) waiting_.pop_front();
  waiting_.push_back(traversal);
}

void OnlineRefinement::remove(const IndexRemoval& scans, const IndexRemoval& keyframes) {
  IndexRemoval traversals;
  for (const IndexRange& hole : keyframes.ranges())
    traversals.add({hole.first / kKeyframesPerTraversal, hole.end / kKeyframesPerTraversal});
  scans.apply(T_graph_refined_);
  traversals_.remove(traversals, scans);
  std::erase_if(waiting_, [&](std::uint32_t traversal) { return traversals.removes(traversal); });
  for (std::uint32_t& traversal : waiting_) traversal = traversals.new_index(traversal);
  swept_ = scans.new_index(swept_);
}

void OnlineRefinement::follow(std::span<const Pose2> T_map_keyframe) {
  for (std::uint32_t traversal = 0; traversal < traversals_.size(); ++traversal)
    traversals_.move(traversal, T_map_body(traversals_[traversal].reference, T_map_keyframe));
}

Pose2 OnlineRefinement::T_map_body(ScanIndex scan, std::span<const Pose2> T_map_keyframe) const {
  return refined(scan, chain_->T_w_body(scan, T_map_keyframe));
}

std::uint32_t OnlineRefinement::newest_traversal() const {
  return static_cast<std::uint32_t>((chain_->size() - 1) / kKeyframesPerTraversal);
}

ScanRange OnlineRefinement::scans_of(std::uint32_t traversal) const {
  const auto first = static_cast<KeyframeId>(traversal * kKeyframesPerTraversal);
  const auto next = static_cast<KeyframeId>((traversal + 1) * kKeyframesPerTraversal);
  return {chain_->scan_of(first),
          traversal < newest_traversal() ? chain_->scan_of(next) : static_cast<ScanIndex>(scans_->size())};
}

/// Whole traversals, as many as fit on both sides of the middle one; of a traversal that is too long its end.
ScanRange OnlineRefinement::window_around(std::uint32_t traversal) const {
  ScanRange window = scans_of(traversal);
  if (window.size() > kMaxScans) return {window.end - kMaxScans, window.end};
  std::uint32_t lowest = traversal;
  std::uint32_t highest = traversal;
  for (bool grows = true; grows;) {
    grows = false;
    if (lowest > 0 && window.end - scans_of(lowest - 1).first <= kMaxScans) {
      window.first = scans_of(--lowest).first;
      grows = true;
    }
    if (highest < newest_traversal() && scans_of(highest + 1).end - window.first <= kMaxScans) {
      window.end = scans_of(++highest).end;
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
    const std::uint32_t place = waiting_.front();
    waiting_.pop_front();
    return window_around(place);
  }
  if (swept_ >= scans_of(newest_traversal()).first) swept_ = 0;
  const ScanRange window = window_around(traversal_of((*scans_)[swept_]));
  swept_ = std::max(window.end, swept_ + 1);
  return window;
}

WindowPoses OnlineRefinement::poses_of(const ScanRange& window, std::span<const Pose2> T_map_keyframe,
                                       std::span<const Pose2> T_local_keyframe) const {
  WindowPoses poses;
  poses.first_scan = window.first > 0 ? window.first - 1 : 0;
  const ScanIndex end = std::min(window.end + 1, static_cast<ScanIndex>(scans_->size()));
  poses.T_map_graph = chain_->T_w_bodies({poses.first_scan, end}, T_map_keyframe);
  poses.T_local_body = chain_->T_w_bodies({poses.first_scan, end}, T_local_keyframe);
  for (ScanIndex i = poses.first_scan; i < end; ++i)
    poses.T_map_body.push_back(refined(i, poses.T_map_graph[i - poses.first_scan]));
  return poses;
}

/// What traversals outside of the window drew where its returns lie.
std::vector<TraversalPoint> OnlineRefinement::walls_around(const ScanRange& window, const WindowPoses& poses,
                                                           std::span<const Pose2> T_map_keyframe) const {
  std::vector<Point2> places_map;
  std::size_t number = 0;
  for (ScanIndex i = window.first; i < window.end; ++i) {
    for (const ScanReturn& beam : scans_->returns(i))
      if (beam.is_hit && number++ % kReturnsPerPlace == 0)
        places_map.push_back(poses.T_map_body[i - poses.first_scan] * scans_->point_body(beam));
  }
  const std::uint32_t first = traversal_of((*scans_)[window.first]);
  const std::uint32_t end = traversal_of((*scans_)[window.end - 1]) + 1;
  std::vector<TraversalPoint> points;
  for (const std::uint32_t traversal : traversals_.near(places_map, first, end)) {
    const Pose2 T_map_reference = T_map_body(traversals_[traversal].reference, T_map_keyframe);
    for (const Point2& p_reference : traversals_[traversal].points_reference)
      points.push_back({T_map_reference * p_reference, traversal});
  }
  return points;
}

Result<ScanRange> OnlineRefinement::step(std::span<const Pose2> T_map_keyframe,
                                         std::span<const Pose2> T_local_keyframe) {
  while (traversals_.size() < newest_traversal())
    file_traversal(static_cast<std::uint32_t>(traversals_.size()), T_map_keyframe);
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
                            std::span<const Pose2> T_map_keyframe) {
  for (ScanIndex i = poses.first_scan + 1; i < window.end; ++i) {
    const std::size_t at = i - poses.first_scan;
    T_graph_refined_[i] = between(poses.T_map_graph[at], poses.T_map_body[at]);
  }
  const std::uint32_t last = traversal_of((*scans_)[window.end - 1]);
  for (std::uint32_t traversal = traversal_of((*scans_)[window.first]);
       traversal <= last && traversal < traversals_.size(); ++traversal)
    file_traversal(traversal, T_map_keyframe);
}

void OnlineRefinement::file_traversal(std::uint32_t traversal, std::span<const Pose2> T_map_keyframe) {
  const ScanRange scans = scans_of(traversal);
  TraversalWalls walls;
  walls.reference = scans.first + scans.size() / 2;
  const Pose2 T_map_reference = T_map_body(walls.reference, T_map_keyframe);
  const Pose2 T_reference_map = T_map_reference.inverse();
  const ScanIndex every = 1 + scans.size() / kMaxScansPerTraversal;
  const std::vector<Pose2> T_map_graph = chain_->T_w_bodies(scans, T_map_keyframe, every);
  CellNumbers cells(kThinningM);
  cells.reset(std::min<std::size_t>(scans_->return_count(scans), kMaxScansPerTraversal * kMaxBeams));
  for (ScanIndex i = scans.first; i < scans.end; i += every) {
    const Pose2 T_reference_body = T_reference_map * refined(i, T_map_graph[(i - scans.first) / every]);
    const std::span<const ScanReturn> beams = scans_->returns(i);
    for (std::size_t k = 0; k < beams.size(); ++k) {
      if (!beams[k].is_hit || is_held_out(*scans_, i, k)) continue;
      const Point2 p = T_reference_body * scans_->point_body(beams[k]);
      if (cells.is_first(p)) walls.points_reference.push_back(p);
    }
  }
  traversals_.set(traversal, std::move(walls), T_map_reference);
}

}  // namespace swiftlet
