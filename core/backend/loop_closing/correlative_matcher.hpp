// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/loop_closing/max_filter.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/loop_closing/tiled_byte_grid.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Of the points, from their frame's origin, and no less than `at_least_m`.
[[nodiscard]] double farthest_m(std::span<const Point2> points, double at_least_m);

/// Where to look for the scan in the submap: around a predicted pose, bounded in each direction.
struct SearchWindow {
  Pose2 T_submap_scan;    ///< the prediction
  double radius_m = 1.0;  ///< in x and in y
  double angle_rad = 0.2;
};

struct MatchResult {
  Pose2 T_submap_scan;         ///< mean of the likely poses: between the cells where the walls
                               ///< decide, midway of the possible along a bare corridor
  Pose2 T_submap_scan_best;    ///< the best of the poses searched, always on the walls
  double score = 0.0;          ///< its mean probability under the points, kernel applied, 0..1
  Eigen::Matrix3d covariance;  ///< of T_submap_scan's vector, from the scores around the optimum, less what
                               ///< the submap's extent alone would give
};

/// The discrete optimum of eq. 22, before refinement: exact within the window.
struct DiscreteMatch {
  int steps_x = 0;  ///< cells from the prediction
  int steps_y = 0;
  int steps_yaw = 0;       ///< angular steps from the prediction
  double score = 0.0;      ///< mean probability, without the preference below
  double preferred = 0.0;  ///< score less a small penalty for distance from the prediction: what is maximised
};

/// Correlative scan-to-submap matching (eqs. 21-22; Olson 2009, "Real-time correlative scan matching") by
/// branch and bound (Hess et al. 2016), on one level: the bounds of 64 tiles are added up at once. Of equal
/// scores the one nearest the prediction wins: along a bare corridor the scores are flat, and the covariance
/// is wide. Allocates in the constructor. Views the submap, which must outlive it.
class CorrelativeMatcher {
 public:
  CorrelativeMatcher(const Submap& submap, std::span<const Point2> points_scan, const SearchWindow& window,
                     const CorrelativeMatcherTuning& tuning = {});

  /// The best match with score >= min_score, or nothing. Nothing either where the best lies at the
  /// window's edge, or many of the points on ground the submap does not know.
  [[nodiscard]] std::optional<MatchResult> match(double min_score) const;
  [[nodiscard]] std::optional<DiscreteMatch> best_by_branch_and_bound(double min_score) const;
  /// The same by trying everything: the slow twin that tests hold the fast one against.
  [[nodiscard]] std::optional<DiscreteMatch> best_by_exhaustion(double min_score) const;

  [[nodiscard]] double angle_step_rad() const { return angle_step_rad_; }
  [[nodiscard]] Pose2 T_submap_scan(const DiscreteMatch& match) const;

 private:
  struct Tile;
  [[nodiscard]] double preference(int steps_x, int steps_y, int steps_yaw) const;
  /// No smaller sum of a list's cells has that score.
  [[nodiscard]] std::uint32_t least_sum(double score) const;
  /// Mean probability over the points that fall on known cells, and their share. The score itself also
  /// rewards covering the submap: along a corridor it would draw every scan to the submap's middle.
  struct KnownCells {
    double score = 0.0;
    double share = 0.0;
  };
  /// `sum` of the probabilities under all points, `known` of them on known cells.
  [[nodiscard]] static KnownCells known_cells(std::uint32_t sum, std::uint32_t known, std::size_t points);
  [[nodiscard]] KnownCells known_cells(const DiscreteMatch& at) const;
  void add_tiles(int x, int y, int yaw, double min_score, std::vector<Tile>& tiles) const;
  void search(const Tile& tile, double min_score, DiscreteMatch& best) const;
  /// Of the submap; 0 outside.
  [[nodiscard]] std::uint8_t value_at(CellIndex cell) const {
    return grid_.contains(cell) ? submap_cells_[grid_.offset(cell)] : std::uint8_t{0};
  }
  [[nodiscard]] const std::vector<CellIndex>& cells(int steps_yaw) const {
    return cells_by_yaw_[slot(steps_yaw)];
  }
  [[nodiscard]] std::size_t slot(int steps_yaw) const {
    const int from_lowest = steps_yaw + yaw_steps_;
    return static_cast<std::size_t>(from_lowest);
  }
  /// `best_score`: of the best, on known cells alone.
  void spread_around(const DiscreteMatch& best, double best_score, MatchResult& result) const;

  GridGeometry grid_;
  std::span<const std::uint8_t> submap_cells_;
  SearchWindow window_;
  CorrelativeMatcherTuning tuning_;
  double angle_step_rad_ = 0.0;
  int linear_steps_ = 0;
  int yaw_steps_ = 0;
  TiledByteGrid tiles_;
  TiledByteGrid bounds_;                              // of tiles
  std::vector<std::vector<CellIndex>> cells_by_yaw_;  // points as cells, one list for each heading
};

}  // namespace swiftlet
