// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/building_axis_prior.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/geometry/angle.hpp"
#include "core/geometry/squared.hpp"

namespace swiftlet {
namespace {

double yaw_map_rad(const PoseGraph& graph, KeyframeId keyframe) {
  return graph.T_map_keyframe[keyframe].yaw_rad();
}

double seen_in_map_rad(const PoseGraph& graph, KeyframeId keyframe, const WallAxis& axis) {
  return yaw_map_rad(graph, keyframe) + axis.yaw_rad;
}

double nearer_to_zero(double a, double b) { return std::abs(a) < std::abs(b) ? a : b; }

/// Likelihood of walls that may stand in any direction of a quarter turn.
constexpr double kAnywherePerRad = 2.0 / kPi;

double gaussian_per_rad(double off_rad, double variance_rad2) {
  return std::exp(-squared(off_rad) / variance_rad2 / 2.0) / std::sqrt(2.0 * kPi * variance_rad2);
}

}  // namespace

void BuildingAxisPrior::add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2,
                            PoseGraph& graph) {
  Sight sight{keyframe, axis, yaw_variance_rad2};
  const std::vector<Fit> fits = fits_of(sight, graph);
  sight.is_elsewhere = std::ranges::all_of(fits, &Fit::is_another_likelier);
  const bool goes_on = !strays_.empty() && continues_strays(sight, graph);
  const bool is_own = goes_on && strays_.front().is_elsewhere;
  const std::optional<std::size_t> shared = is_own ? std::nullopt : shared_axis(fits);
  if (shared) {
    observe(*shared, yaw_variance_rad2);
    hold(sight, *shared, graph);
  }
  if (shared || !goes_on) drop_strays();
  if (shared) return;
  strays_.push_back(sight);
  if (strays_.size() < kSightsApart || !strays_.front().is_elsewhere) return;
  const std::size_t added = shared_.size();
  observe(added, strays_.front().yaw_variance_rad2);
  for (const Sight& stray : strays_) hold(stray, added, graph);
  strays_.clear();
}

std::vector<BuildingAxisPrior::Fit> BuildingAxisPrior::fits_of(const Sight& sight,
                                                               const PoseGraph& graph) const {
  if (walls_.empty()) return {};
  const std::vector<double> directions = directions_rad(graph);
  const double seen_rad = seen_in_map_rad(graph, sight.keyframe, sight.axis);
  // Of the last heading, which the map may not have followed yet.
  const double last_off_rad =
      wrap_axis(seen_in_map_rad(graph, graph.headings.back().pose, walls_.back().axis) -
                directions[walls_.back().shared]);
  const double sight_rad2 = squared(sight.axis.sigma_rad);
  const double another_per_rad = (1.0 + unheld_ + static_cast<double>(strays_.size())) * kAnywherePerRad;
  std::vector<Fit> fits;
  for (std::size_t k = 0; k < shared_.size(); ++k) {
    const double in_map_rad = wrap_axis(seen_rad - directions[k]);
    const double off_rad = nearer_to_zero(in_map_rad, wrap_axis(in_map_rad - last_off_rad));
    const double turned_rad2 = shared_[k].variance_rad2 + sight.yaw_variance_rad2;
    const double known_per_rad =
        static_cast<double>(shared_[k].headings) * likelihood_per_rad(off_rad, turned_rad2, sight_rad2);
    fits.push_back({.misfit = squared(off_rad) / (turned_rad2 + sight_rad2),
                    .other_way_round = squared(kPi / 2.0 - std::abs(off_rad)) / (turned_rad2 + sight_rad2),
                    .is_another_likelier = another_per_rad > known_per_rad});
  }
  return fits;
}

/// Of walls so far off their axis.
double BuildingAxisPrior::likelihood_per_rad(double off_rad, double turned_rad2, double sight_rad2) const {
  const double slipped_rad2 = squared(tuning_.slip_factor) * turned_rad2;
  return (1.0 - tuning_.slip_share) * gaussian_per_rad(off_rad, turned_rad2 + sight_rad2) +
         tuning_.slip_share * gaussian_per_rad(off_rad, slipped_rad2 + sight_rad2);
}

std::optional<std::size_t> BuildingAxisPrior::shared_axis(const std::vector<Fit>& fits) const {
  if (fits.empty()) return shared_.size();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  double rival = least;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const double rarity = -2.0 * std::log(static_cast<double>(shared_[k].headings));
    const double misfit = rarity + fits[k].misfit;
    rival = std::min({rival, rarity + fits[k].other_way_round, std::max(least, misfit)});
    if (misfit >= least) continue;
    best = k;
    least = misfit;
  }
  if (fits[best].is_another_likelier) return std::nullopt;
  if (rival - least < 2.0 * tuning_.min_log_odds) return std::nullopt;
  return best;
}

void BuildingAxisPrior::drop_strays() {
  unheld_ += static_cast<double>(strays_.size());
  strays_.clear();
}

bool BuildingAxisPrior::continues_strays(const Sight& sight, const PoseGraph& graph) const {
  const Sight& last = strays_.back();
  const double off_rad = wrap_axis(seen_in_map_rad(graph, sight.keyframe, sight.axis) -
                                   seen_in_map_rad(graph, last.keyframe, last.axis));
  const double variance_rad2 = std::max(0.0, sight.yaw_variance_rad2 - last.yaw_variance_rad2) +
                               squared(sight.axis.sigma_rad) + squared(last.axis.sigma_rad);
  return squared(off_rad) <= squared(tuning_.gate_sigmas) * variance_rad2;
}

/// Before the heading is added. While one axis is in sight it corrects what turning loses, and the variances
/// of the others stay as they were.
void BuildingAxisPrior::observe(std::size_t shared, double yaw_variance_rad2) {
  if (shared == shared_.size()) shared_.emplace_back();
  if (!walls_.empty() && shared != walls_.back().shared)
    for (Shared& other : shared_) other.variance_rad2 += yaw_variance_rad2;
  shared_[shared].variance_rad2 = 0.0;
}

void BuildingAxisPrior::hold(const Sight& sight, std::size_t shared, PoseGraph& graph) {
  ++shared_[shared].headings;
  walls_.push_back({sight.axis, shared});
  const double variance_rad2 = tuning_.variance_factor * squared(sight.axis.sigma_rad);
  graph.headings.push_back({.pose = sight.keyframe, .information = 1.0 / variance_rad2});
}

/// Circular means over a quarter turn, weighted by the information that DCS leaves of each heading.
std::vector<double> BuildingAxisPrior::directions_rad(const PoseGraph& graph) const {
  std::vector<std::complex<double>> sums(shared_.size());
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const HeadingFactor<KeyframeId>& heading = graph.headings[i];
    const double weight = squared(heading.dcs_scale) * heading.information;
    sums[walls_[i].shared] += std::polar(weight, 4.0 * seen_in_map_rad(graph, heading.pose, walls_[i].axis));
  }
  std::vector<double> directions(sums.size());
  std::transform(sums.begin(), sums.end(), directions.begin(),
                 [](const std::complex<double>& sum) { return std::arg(sum) / 4.0; });
  return directions;
}

void BuildingAxisPrior::erase(const IdRanges<KeyframeId>& pruned, PoseGraph& graph) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    if (pruned.contains(graph.headings[i].pose)) {
      --shared_[walls_[i].shared].headings;
      continue;
    }
    graph.headings[kept] = graph.headings[i];
    walls_[kept++] = walls_[i];
  }
  if (!walls_.empty()) unheld_ *= static_cast<double>(kept) / static_cast<double>(walls_.size());
  graph.headings.resize(kept);
  walls_.resize(kept);
  std::erase_if(strays_, [&](const Sight& stray) { return pruned.contains(stray.keyframe); });
  if (walls_.empty()) strays_.clear();
  forget_unseen_axes();
}

void BuildingAxisPrior::forget_unseen_axes() {
  std::vector<std::size_t> number(shared_.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < shared_.size(); ++k) {
    number[k] = kept;
    if (shared_[k].headings > 0) shared_[kept++] = shared_[k];
  }
  shared_.resize(kept);
  for (Walls& walls : walls_) walls.shared = number[walls.shared];
}

void BuildingAxisPrior::update(PoseGraph& graph) const {
  const std::vector<double> directions = directions_rad(graph);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    HeadingFactor<KeyframeId>& heading = graph.headings[i];
    const double seen_rad = seen_in_map_rad(graph, heading.pose, walls_[i].axis);
    heading.yaw_map_rad =
        yaw_map_rad(graph, heading.pose) - wrap_axis(seen_rad - directions[walls_[i].shared]);
  }
}

}  // namespace swiftlet
