// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/map_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "core/backend/store/traversal.hpp"
#include "core/geometry/grid.hpp"

namespace swiftlet {
namespace {

/// The votes on one cell.
class Cell {
 public:
  void add(TraversalId traversal, bool is_wall) {
    const bool is_new = traversal_ != traversal;
    if (!is_new && (is_wall_ || !is_wall)) return;
    walls_ += is_wall ? 1U : 0U;
    voters_ += is_new ? 1U : 0U;
    traversal_ = traversal;
    is_wall_ = is_wall;
  }
  [[nodiscard]] std::size_t walls() const { return walls_; }
  [[nodiscard]] std::size_t voters() const { return voters_; }

 private:
  std::uint32_t walls_ = 0;
  std::uint32_t voters_ = 0;
  std::optional<TraversalId> traversal_;  // the last that voted, and ...
  bool is_wall_ = false;                  // ... how
};

/// Probability of votes one after another: of each kind (k + 1/2) / (n + 1) after k of its kind among n.
class VoteProbabilities {
 public:
  double log_of(const Cell& cell) {
    while (votes_.size() <= cell.voters()) {
      const auto before = static_cast<double>(votes_.size() - 1);
      of_one_kind_.push_back(of_one_kind_.back() + std::log(before + 0.5));
      votes_.push_back(votes_.back() + std::log(before + 1.0));
    }
    return of_one_kind_[cell.walls()] + of_one_kind_[cell.voters() - cell.walls()] - votes_[cell.voters()];
  }

 private:
  std::vector<double> of_one_kind_{0.0};
  std::vector<double> votes_{0.0};
};

class VotedGrid {
 public:
  /// Of a storey whose beams are counted next.
  void enter(StoreyId storey) { storey_ = storey; }
  void add(CellIndex cell, TraversalId traversal, bool is_wall) {
    const CellIndex tile{cell.x >> kBits, cell.y >> kBits};
    const Place place{storey_, tile};
    if (newest_ == nullptr || newest_place_ != place) newest_ = &tiles_[place];
    newest_place_ = place;
    const auto in_tile = [](std::int32_t c) { return static_cast<std::size_t>(c & (kSide - 1)); };
    (*newest_)[in_tile(cell.y) * kSide + in_tile(cell.x)].add(traversal, is_wall);
  }
  [[nodiscard]] double log_probability() const {
    VoteProbabilities probabilities;
    double sum = 0.0;
    for (const auto& [place, tile] : tiles_)
      for (const Cell& cell : tile) sum += probabilities.log_of(cell);
    return sum;
  }

 private:
  static constexpr int kBits = 5;
  static constexpr std::int32_t kSide = 1 << kBits;
  using Tile = std::array<Cell, std::size_t{kSide} * kSide>;
  struct Place {
    StoreyId storey{};
    CellIndex tile;
    auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr)
  };

  std::map<Place, Tile> tiles_;
  StoreyId storey_{};
  Place newest_place_;
  Tile* newest_ = nullptr;
};

constexpr int kGrids = 16;  // one alone errs by a hundred nats; docs/decisions/0032-a-map-has-evidence.md

/// Spreads evenly over offsets and quarter turns, however many there are: multiples of irrational shares,
/// those of a plane by the root of x³ = x + 1.
Pose2 T_grid_map_of(int grid, double cell_m) {
  constexpr double kPlastic = 1.324717957244746;
  return {grid * cell_m / kPlastic, grid * cell_m / (kPlastic * kPlastic),
          grid * 0.5 * std::numbers::pi / std::numbers::phi};
}

}  // namespace

double log_evidence_in_grid(const ScanStore& scans, std::span<const Pose2> T_map_body, double cell_m,
                            const Pose2& T_grid_map) {
  VotedGrid grid;
  const auto in_cells = [&](const Point2& p) { return Point2{p.x_m / cell_m, p.y_m / cell_m}; };
  std::size_t i = 0;
  for (const StoredScan& scan : scans.all().values()) {
    const Pose2 T = T_grid_map * T_map_body[i++];
    const TraversalId traversal = traversal_of(scan);
    grid.enter(scan.storey);
    for (const ScanReturn& beam : scans.returns(scan)) {
      if (!beam.is_hit) continue;
      const Point2 p_body = scans.point_body(beam);
      // The wall may lie in the next cell.
      const double free =
          std::max(0.0, 1.0 - std::numbers::sqrt2 * cell_m / static_cast<double>(beam.distance_m));
      walk_ray(in_cells(T.position()), in_cells(T * Point2{free * p_body.x_m, free * p_body.y_m}),
               [&](CellIndex cell) { grid.add(cell, traversal, false); });
      grid.add(cell_of(in_cells(T * p_body)), traversal, true);
    }
  }
  return grid.log_probability();
}

double map_log_evidence(const ScanStore& scans, std::span<const Pose2> T_map_body, double cell_m) {
  double sum = 0.0;
  for (int grid = 0; grid < kGrids; ++grid)
    sum += log_evidence_in_grid(scans, T_map_body, cell_m, T_grid_map_of(grid, cell_m));
  return sum / kGrids;
}

}  // namespace swiftlet
