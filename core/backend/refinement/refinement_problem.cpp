// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/refinement_problem.hpp"

namespace swiftlet {

WallMap RefinementProblem::walls_at(const std::vector<Pose2>& T_map_body, double radius_m,
                                    std::span<const TraversalPoint> others_thinned) const {
  std::vector<TraversalPoint> points;
  points.reserve(returns_.size());
  for (const PlacedReturn& r : returns_)
    if (!r.held_out) points.push_back({T_map_body[index_of(r.pose)] * r.p_body, r.traversal});
  return {others_thinned, points, radius_m, tuning_};
}

double RefinementProblem::held_out_error_m(const WallMap& walls, const std::vector<Pose2>& T_map_body) const {
  double sum_m = 0.0;
  std::size_t count = 0;
  for_held_out(walls, T_map_body, [&](std::uint32_t, double distance_m) {
    sum_m += distance_m;
    ++count;
  });
  return count == 0 ? 0.0 : sum_m / static_cast<double>(count);
}

}  // namespace swiftlet
