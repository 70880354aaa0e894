// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/trajectory_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/geometry/rigid_alignment.hpp"

namespace swiftlet {

TrajectoryError trajectory_error(std::span<const Point2> estimate_m, std::span<const Point2> truth_m) {
  SWIFTLET_CHECK(estimate_m.size() == truth_m.size(), "the paths are paired by position");
  TrajectoryError error;
  error.pairs = estimate_m.size();
  if (error.pairs == 0) return error;
  error.T_truth_estimate = rigid_alignment(estimate_m, truth_m);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < error.pairs; ++i) {
    const double distance = distance_m(error.T_truth_estimate * estimate_m[i], truth_m[i]);
    sum += distance;
    sum_of_squares += distance * distance;
    error.max_m = std::max(error.max_m, distance);
  }
  const auto count = static_cast<double>(error.pairs);
  error.mean_m = sum / count;
  error.rmse_m = std::sqrt(sum_of_squares / count);
  return error;
}

PathError path_error(const StampedPath& estimate, const StampedPath& truth) {
  std::vector<HostTime> stamps;
  std::vector<Point2> estimate_m;
  std::vector<Point2> truth_m;
  for (const StampedPose& at : estimate.poses()) {
    stamps.push_back(at.stamp);
    const std::optional<Point2> true_position = truth.position_at(at.stamp);
    if (!true_position) continue;
    estimate_m.push_back(at.pose.position());
    truth_m.push_back(*true_position);
  }
  StampMatching matching = match_stamps(std::move(stamps), truth);
  matching.between = std::erase_if(matching.unmatched,
                                   [&truth](HostTime stamp) { return truth.position_at(stamp).has_value(); });
  return {trajectory_error(estimate_m, truth_m), std::move(matching)};
}

}  // namespace swiftlet
