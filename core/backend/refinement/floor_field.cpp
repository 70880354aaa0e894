// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/floor_field.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

// What a flow sensor can do, so that no step of the solver leads beyond: it sees at least two fifths of the
// motion and at most twice as much.
constexpr double kLeastError = -0.5;
constexpr double kMostError = 1.5;

}  // namespace

FloorField::Key FloorField::key_between(const PlaceOnFloor& from, const PlaceOnFloor& to) const {
  const auto cell = [&](double a_m, double b_m) {
    return static_cast<std::int32_t>(std::floor(0.5 * (a_m + b_m) / tuning_.cell_m));
  };
  return {to.storey, cell(from.p_map.x_m, to.p_map.x_m), cell(from.p_map.y_m, to.p_map.y_m)};
}

void FloorField::place(std::span<const PlaceOnFloor> nodes) {
  cell_of_.assign(nodes.size(), 0);
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const auto [at, is_new] = cells_.emplace(key_between(nodes[k - 1], nodes[k]), errors_.size());
    if (is_new) errors_.push_back(0.0);
    cell_of_[k] = at->second;
  }
}

double FloorField::information(std::size_t cell) const {
  return 2.0 / (tuning_.usual_error * tuning_.usual_error + errors_[cell] * errors_[cell]);
}

void FloorField::change(std::size_t cell, double by) {
  errors_[cell] = std::clamp(errors_[cell] + by, kLeastError, kMostError);
}

double FloorField::cost() const {
  double sum = 0.0;
  for (const double error : errors_)
    sum += std::log1p(error * error / (tuning_.usual_error * tuning_.usual_error));
  return sum;
}

}  // namespace swiftlet
