// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/correlative_matcher.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

namespace swiftlet {
namespace {

constexpr int kTile = TiledByteGrid::kSide;  // positions a side: tried at once
constexpr int kSpreadStrideCells = 2;        // between positions evaluated: enough under a kernel of three

/// Of max_ahead(): wider and higher by what a tile reaches.
GridGeometry grown(GridGeometry geometry) {
  geometry.width += kTile - 1;
  geometry.height += kTile - 1;
  return geometry;
}

/// Of submap cells, which hold 255 times theirs.
double mean_probability(std::uint32_t sum, std::size_t count) {
  return static_cast<double>(sum) / (255.0 * static_cast<double>(count));
}

std::vector<std::uint8_t> known_of(std::span<const std::uint8_t> submap_cells) {
  std::vector<std::uint8_t> known(submap_cells.size());
  std::transform(submap_cells.begin(), submap_cells.end(), known.begin(),
                 [](std::uint8_t value) { return static_cast<std::uint8_t>(value != 0 ? 1 : 0); });
  return known;
}

/// The sums at `side` x `side` positions, `stride` apart from (x, y) on, row by row.
std::vector<std::uint32_t> sums_of_square(const TiledByteGrid& tiles, std::span<const CellIndex> cells, int x,
                                          int y, int side, int stride) {
  std::vector<std::uint32_t> square(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int row = 0; row < side; row += TiledByteGrid::kSide) {
    for (int column = 0; column < side; column += TiledByteGrid::kSide) {
      const TiledByteGrid::Sums sums = tiles.sums(cells, x + stride * column, y + stride * row);
      const int count = std::min(TiledByteGrid::kSide, side - column);
      for (int k = 0; k < TiledByteGrid::kSide && row + k < side; ++k) {
        const int from = k * TiledByteGrid::kSide;
        const int to = (row + k) * side + column;
        std::copy_n(sums.begin() + from, count, square.begin() + to);
      }
    }
  }
  return square;
}

/// Weighted moments of steps from the optimum.
struct Moments {
  double weight = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  void add(double w, const Eigen::Vector3d& d) {
    weight += w;
    first += w * d;
    second += w * d * d.transpose();
  }
  [[nodiscard]] Eigen::Vector3d mean() const { return first / weight; }
  [[nodiscard]] Eigen::Matrix3d covariance() const { return second / weight - mean() * mean().transpose(); }
};

/// A scan can only match where the submap covers it: along a bare corridor the scores fall off at the
/// submap's ends for no other reason, and that is no evidence. The information that the coverage alone would
/// give is subtracted. Where nothing is left, next to nothing remains: many such matches of one passage must
/// not add up to a place along it.
void take_out_coverage(const Eigen::Matrix3d& coverage, double cell_m, double min_information,
                       Eigen::Matrix3d& covariance) {
  Eigen::Matrix2d covered = coverage.topLeftCorner<2, 2>();
  covered.diagonal().array() += cell_m * cell_m;
  Eigen::Matrix3d information = covariance.inverse();
  information.topLeftCorner<2, 2>() -= covered.inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d weights = solver.eigenvalues().cwiseMax(min_information);
  covariance =
      solver.eigenvectors() * weights.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

/// Positions [x, x + kTile) x [y, y + kTile), with one heading.
struct CorrelativeMatcher::Tile {
  int x = 0;
  int y = 0;
  int yaw = 0;
  double bound = 0.0;  ///< no pose in the tile is preferred more
};

double farthest_m(std::span<const Point2> points, double at_least_m) {
  double farthest = at_least_m;
  for (const Point2& p : points) farthest = std::max(farthest, std::hypot(p.x_m, p.y_m));
  return farthest;
}

CorrelativeMatcher::CorrelativeMatcher(const Submap& submap, std::span<const Point2> points_scan,
                                       const SearchWindow& window, const CorrelativeMatcherTuning& tuning)
    : grid_(submap.geometry),
      submap_cells_(submap.cells),
      window_(window),
      tuning_(tuning),
      linear_steps_(static_cast<int>(std::ceil(window.radius_m / grid_.resolution_m))),
      tiles_(submap.geometry, submap.cells, 1),
      bounds_(grown(submap.geometry), max_ahead(submap.geometry, submap.cells, kTile), kTile) {
  // One step turns the farthest point by one cell (Hess et al. 2016, eq. 7).
  const double ratio = grid_.resolution_m / farthest_m(points_scan, grid_.resolution_m);
  angle_step_rad_ = std::acos(1.0 - 0.5 * ratio * ratio);
  yaw_steps_ = static_cast<int>(std::ceil(window.angle_rad / angle_step_rad_));
  cells_by_yaw_.resize(2 * static_cast<std::size_t>(yaw_steps_) + 1);
  for (int yaw = -yaw_steps_; yaw <= yaw_steps_; ++yaw) {
    const Pose2 T(window.T_submap_scan.x_m(), window.T_submap_scan.y_m(),
                  window.T_submap_scan.yaw_rad() + yaw * angle_step_rad_);
    auto& list = cells_by_yaw_[slot(yaw)];
    list.resize(points_scan.size());
    std::ranges::transform(points_scan, list.begin(), [&](const Point2& p) { return grid_.cell(T * p); });
  }
}

Pose2 CorrelativeMatcher::T_submap_scan(const DiscreteMatch& match) const {
  const double cell_m = grid_.resolution_m;
  const Pose2& predicted = window_.T_submap_scan;
  return {predicted.x_m() + match.steps_x * cell_m, predicted.y_m() + match.steps_y * cell_m,
          predicted.yaw_rad() + match.steps_yaw * angle_step_rad_};
}

double CorrelativeMatcher::preference(int steps_x, int steps_y, int steps_yaw) const {
  const double linear = std::max(1, linear_steps_);
  const double angular = std::max(1, yaw_steps_);
  return -tuning_.edge_penalty * ((steps_x * steps_x + steps_y * steps_y) / (linear * linear) +
                                  steps_yaw * steps_yaw / (angular * angular));
}

std::uint32_t CorrelativeMatcher::least_sum(double score) const {
  constexpr double kRounding = 1e-9;
  const auto points = static_cast<double>(cells_by_yaw_.front().size());
  return static_cast<std::uint32_t>(std::max(0.0, (score - kRounding) * 255.0 * points));
}

CorrelativeMatcher::KnownCells CorrelativeMatcher::known_cells(std::uint32_t sum, std::uint32_t known,
                                                               std::size_t points) {
  return {static_cast<double>(sum) / (255.0 * std::max(known, 1U)),
          static_cast<double>(known) / static_cast<double>(points)};
}

CorrelativeMatcher::KnownCells CorrelativeMatcher::known_cells(const DiscreteMatch& at) const {
  std::uint32_t sum = 0;
  std::uint32_t known = 0;
  const auto& list = cells(at.steps_yaw);
  for (const CellIndex& c : list) {
    const std::uint8_t value = value_at({c.x + at.steps_x, c.y + at.steps_y});
    sum += value;
    known += value != 0 ? 1 : 0;
  }
  return known_cells(sum, known, list.size());
}

/// The tiles of `kTile` x `kTile` tiles from (x, y) on that hold a pose with that score.
void CorrelativeMatcher::add_tiles(int x, int y, int yaw, double min_score, std::vector<Tile>& tiles) const {
  const auto& list = cells(yaw);
  // The grid of the bounds begins a tile less a cell before the submap's.
  const std::uint32_t least = least_sum(min_score);
  const TiledByteGrid::Sums sums = bounds_.sums(list, x + kTile - 1, y + kTile - 1, least);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k] < least) continue;
    const double score = mean_probability(sums[k], list.size());
    Tile tile{x + kTile * (static_cast<int>(k) % kTile), y + kTile * (static_cast<int>(k) / kTile), yaw,
              score};
    if (score < min_score || tile.x > linear_steps_ || tile.y > linear_steps_) continue;
    const int nearest_x = std::clamp(0, tile.x, tile.x + kTile - 1);
    const int nearest_y = std::clamp(0, tile.y, tile.y + kTile - 1);
    tile.bound += preference(nearest_x, nearest_y, yaw);
    tiles.push_back(tile);
  }
}

void CorrelativeMatcher::search(const Tile& tile, double min_score, DiscreteMatch& best) const {
  const auto& list = cells(tile.yaw);
  // No pose is preferred more than its score.
  const std::uint32_t least = least_sum(std::max(min_score, best.preferred));
  const TiledByteGrid::Sums sums = tiles_.sums(list, tile.x, tile.y, least);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k] < least) continue;
    const int x = tile.x + static_cast<int>(k) % kTile;
    const int y = tile.y + static_cast<int>(k) / kTile;
    if (x > linear_steps_ || y > linear_steps_) continue;
    const double score = mean_probability(sums[k], list.size());
    const double preferred = score + preference(x, y, tile.yaw);
    if (score >= min_score && preferred > best.preferred) best = {x, y, tile.yaw, score, preferred};
  }
}

std::optional<DiscreteMatch> CorrelativeMatcher::best_by_branch_and_bound(double min_score) const {
  std::vector<Tile> tiles;
  for (int yaw = -yaw_steps_; yaw <= yaw_steps_; ++yaw)
    for (int y = -linear_steps_; y <= linear_steps_; y += kTile * kTile)
      for (int x = -linear_steps_; x <= linear_steps_; x += kTile * kTile)
        add_tiles(x, y, yaw, min_score, tiles);
  std::ranges::stable_sort(tiles, std::greater(), &Tile::bound);
  DiscreteMatch best;
  best.score = best.preferred = -1.0;
  for (const Tile& tile : tiles) {
    if (tile.bound <= best.preferred) break;
    search(tile, min_score, best);
  }
  if (best.score < min_score) return std::nullopt;
  return best;
}

std::optional<DiscreteMatch> CorrelativeMatcher::best_by_exhaustion(double min_score) const {
  DiscreteMatch best;
  best.score = best.preferred = -1.0;
  for (int yaw = -yaw_steps_; yaw <= yaw_steps_; ++yaw) {
    for (int y = -linear_steps_; y <= linear_steps_; ++y) {
      for (int x = -linear_steps_; x <= linear_steps_; ++x) {
        std::uint32_t sum = 0;
        for (const CellIndex& c : cells(yaw)) sum += value_at({c.x + x, c.y + y});
        const double score = mean_probability(sum, cells(yaw).size());
        const double preferred = score + preference(x, y, yaw);
        if (score >= min_score && preferred > best.preferred) best = {x, y, yaw, score, preferred};
      }
    }
  }
  if (best.score < min_score) return std::nullopt;
  return best;
}

/// Olson 2009, eq. 6: mean and covariance of the poses around the optimum, weighted by likelihood. The mean
/// lies between the cells: the refinement below the grid's resolution.
void CorrelativeMatcher::spread_around(const DiscreteMatch& best, double best_score,
                                       MatchResult& result) const {
  const double cell_m = grid_.resolution_m;
  const int stride = kSpreadStrideCells;
  const double reach_m = std::min(std::max(window_.radius_m, tuning_.min_spread_m), tuning_.max_spread_m);
  const int reach = stride * static_cast<int>(std::lround(reach_m / (stride * cell_m)));
  const int yaw_low = std::max(-yaw_steps_, best.steps_yaw - tuning_.yaw_spread_steps);
  const int yaw_high = std::min(yaw_steps_, best.steps_yaw + tuning_.yaw_spread_steps);
  const int side = 2 * reach / stride + 1;  // positions
  const TiledByteGrid values(grid_, submap_cells_, stride);
  const TiledByteGrid knowns(grid_, known_of(submap_cells_), stride);
  Moments likely;
  Moments covered;
  for (int yaw = yaw_low; yaw <= yaw_high; ++yaw) {
    const auto& list = cells(yaw);
    const auto sums = sums_of_square(values, list, best.steps_x - reach, best.steps_y - reach, side, stride);
    const auto known = sums_of_square(knowns, list, best.steps_x - reach, best.steps_y - reach, side, stride);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const KnownCells at = known_cells(sums[i], known[i], list.size());
      if (at.share < tuning_.min_known_share) continue;
      const int dx = stride * (static_cast<int>(i) % side) - reach;
      const int dy = stride * (static_cast<int>(i) / side) - reach;
      const Eigen::Vector3d d(dx * cell_m, dy * cell_m, (yaw - best.steps_yaw) * angle_step_rad_);
      // Points on unknown ground are no evidence for the pose or against it.
      likely.add(std::exp(tuning_.likelihood_per_score * at.share * (at.score - best_score)), d);
      covered.add(1.0, d);
    }
  }
  result.covariance = likely.covariance();
  const Eigen::Vector3d floor_sigma(tuning_.floor_sigma_m, tuning_.floor_sigma_m,
                                    tuning_.floor_sigma_yaw_rad);
  result.covariance.diagonal() += floor_sigma.cwiseAbs2();
  take_out_coverage(covered.covariance(), cell_m, tuning_.min_information, result.covariance);
  const Pose2 T = T_submap_scan(best);
  const Eigen::Vector3d mean = likely.mean();
  result.T_submap_scan = Pose2(T.x_m() + mean.x(), T.y_m() + mean.y(), T.yaw_rad() + mean.z());
}

std::optional<MatchResult> CorrelativeMatcher::match(double min_score) const {
  const std::optional<DiscreteMatch> best = best_by_branch_and_bound(min_score);
  if (!best) return std::nullopt;
  if (std::max(std::abs(best->steps_x), std::abs(best->steps_y)) > tuning_.edge_of_window * linear_steps_)
    return std::nullopt;
  const KnownCells known = known_cells(*best);
  if (known.share < tuning_.min_known_share) return std::nullopt;
  MatchResult result;
  result.T_submap_scan_best = T_submap_scan(*best);
  result.score = best->score;
  spread_around(*best, known.score, result);
  return result;
}

}  // namespace swiftlet
