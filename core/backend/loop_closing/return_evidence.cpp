// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/return_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace swiftlet {
namespace {

constexpr double kPerProbability = 255.0;

/// 255 * p(occupied); 0 where nothing is known.
int occupied_at(const Submap& submap, CellIndex cell) {
  return submap.geometry.contains(cell) ? submap.cells[submap.geometry.offset(cell)] : 0;
}

/// A beam goes through a wall where two cells in a row are surely occupied, farther than the tolerance from
/// both its ends.
bool passes_a_wall(const Submap& submap, const Point2& from_cells, const Point2& end_cells,
                   const ConfidenceTuning& tuning) {
  const double x = end_cells.x_m - from_cells.x_m;
  const double y = end_cells.y_m - from_cells.y_m;
  const double share = tuning.tolerance_m / submap.geometry.resolution_m / std::hypot(x, y);
  if (share >= 0.5) return false;
  const double wall = tuning.wall_probability * kPerProbability;
  int in_a_row = 0;
  bool passes = false;
  walk_ray({from_cells.x_m + share * x, from_cells.y_m + share * y},
           {end_cells.x_m - share * x, end_cells.y_m - share * y}, [&](CellIndex cell) {
             in_a_row = occupied_at(submap, cell) > wall ? in_a_row + 1 : 0;
             passes |= in_a_row >= 2;
           });
  return passes;
}

/// ... and through it whatever side the vehicle is off to: a beam along a wall goes through it where the pose
/// is off by little.
bool passes_a_wall_on_any_side(const Submap& submap, const Point2& from_cells, const Point2& end_cells,
                               const ConfidenceTuning& tuning) {
  if (!passes_a_wall(submap, from_cells, end_cells, tuning)) return false;
  const double x = end_cells.x_m - from_cells.x_m;
  const double y = end_cells.y_m - from_cells.y_m;
  const double scale = tuning.tolerance_m / submap.geometry.resolution_m / std::hypot(x, y);
  const auto passes_beside = [&](double side) {
    const double dx = -side * scale * y;
    const double dy = side * scale * x;
    return passes_a_wall(submap, {from_cells.x_m + dx, from_cells.y_m + dy},
                         {end_cells.x_m + dx, end_cells.y_m + dy}, tuning);
  };
  return passes_beside(1.0) && passes_beside(-1.0);
}

/// What stands around the end of a beam, in the rows of cells that the tolerance reaches.
ReturnVerdict verdict_of_end(const Submap& submap, const Point2& end_cells, const ConfidenceTuning& tuning) {
  const double reach_cells = tuning.tolerance_m / submap.geometry.resolution_m;
  const int reach = static_cast<int>(reach_cells);
  const double wall = tuning.occupied_probability * kPerProbability;
  const double open = tuning.free_probability * kPerProbability;
  const CellIndex end = cell_of(end_cells);
  const GridGeometry& grid = submap.geometry;
  int around = 0;
  int free = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    const int half = static_cast<int>(std::sqrt(reach_cells * reach_cells - dy * dy));
    around += 2 * half + 1;
    if (end.y + dy < 0 || end.y + dy >= grid.height) continue;
    const int first = std::max(end.x - half, 0);
    const int last = std::min(end.x + half, grid.width - 1);
    if (first > last) continue;
    const std::size_t row = grid.offset({0, end.y + dy});
    for (int cx = first; cx <= last; ++cx) {
      const int occupied = submap.cells[row + static_cast<std::size_t>(cx)];
      if (occupied > wall) return ReturnVerdict::kAgrees;
      free += static_cast<int>(occupied > 0 && occupied < open);
    }
  }
  return 2 * free > around ? ReturnVerdict::kContradicts : ReturnVerdict::kUnknown;
}

}  // namespace

std::vector<SubmapAround> ReturnEvidence::around(const Pose2& T_map_body, double ended_by_m, StoreyId storey,
                                                 std::span<const std::shared_ptr<const Submap>> submaps,
                                                 const KeyframePoses& T_map_keyframe) const {
  std::vector<SubmapAround> around;
  const double reach_m = tuning_->near_m;
  for (const auto& submap : submaps) {
    if (submap->storey != storey || submap->end_path_m > ended_by_m) continue;
    const Pose2 T_submap_map = T_map_keyframe[submap->reference].inverse();
    const Point2 at = T_submap_map * T_map_body.position();
    if (at.x_m > submap->low_m.x_m - reach_m && at.x_m < submap->high_m.x_m + reach_m &&
        at.y_m > submap->low_m.y_m - reach_m && at.y_m < submap->high_m.y_m + reach_m)
      around.push_back({submap, T_submap_map});
  }
  return around;
}

double ReturnEvidence::against(const ScanRange& scans, std::span<const Pose2> T_map_body, double older_by_m,
                               std::span<const std::shared_ptr<const Submap>> submaps,
                               const KeyframePoses& T_map_keyframe) const {
  double evidence = 0.0;
  std::optional<KeyframeId> looked_at;
  std::optional<Pose2> T_map_compared;
  std::vector<SubmapAround> near;
  std::size_t i = 0;
  for (const StoredScan& scan : scans_->all().values(scans)) {
    const Pose2& T = T_map_body[i++];
    if (T_map_compared && !is_farther_on(*T_map_compared, T)) continue;
    T_map_compared = T;
    if (looked_at != scan.keyframe)
      near = around(T, scan.path_m - older_by_m, scan.storey, submaps, T_map_keyframe);
    looked_at = scan.keyframe;
    const std::span<const ScanReturn> returns = scans_->returns(scan);
    for (const ScanReturn& beam : returns)
      if (beam.is_hit) evidence += weight_of(returns) * log_odds_of(verdict(near, T, beam));
  }
  return evidence;
}

bool ReturnEvidence::is_farther_on(const Pose2& T_map_compared, const Pose2& T_map_body) const {
  const Pose2 moved = between(T_map_compared, T_map_body);
  return std::hypot(moved.x_m(), moved.y_m()) >= tuning_->way_between_m ||
         std::abs(moved.yaw_rad()) >= tuning_->turn_between_rad;
}

double ReturnEvidence::weight_of(std::span<const ScanReturn> returns) const {
  return std::min(1.0, tuning_->returns_in_full / static_cast<double>(returns.size()));
}

double ReturnEvidence::log_odds_of(ReturnVerdict verdict) const {
  if (verdict == ReturnVerdict::kUnknown) return 0.0;
  const double right = tuning_->share_if_right;
  const double off = tuning_->share_if_off;
  return verdict == ReturnVerdict::kContradicts ? std::log(off / right)
                                                : std::log((1.0 - off) / (1.0 - right));
}

/// A wall in the way in one submap contradicts, whatever others show; else a wall near the end in any agrees.
ReturnVerdict ReturnEvidence::verdict(std::span<const SubmapAround> around, const Pose2& T_map_body,
                                      const ScanReturn& beam) const {
  const Point2 from_map = T_map_body.position();
  const Point2 end_map = T_map_body * scans_->point_body(beam);
  ReturnVerdict verdict = ReturnVerdict::kUnknown;
  for (const SubmapAround& older : around) {
    const Point2 from_cells = older.submap->geometry.in_cells(older.T_submap_map * from_map);
    const Point2 end_cells = older.submap->geometry.in_cells(older.T_submap_map * end_map);
    if (passes_a_wall_on_any_side(*older.submap, from_cells, end_cells, *tuning_))
      return ReturnVerdict::kContradicts;
    if (verdict == ReturnVerdict::kAgrees) continue;
    const ReturnVerdict here = verdict_of_end(*older.submap, end_cells, *tuning_);
    if (here != ReturnVerdict::kUnknown) verdict = here;
  }
  return verdict;
}

}  // namespace swiftlet
