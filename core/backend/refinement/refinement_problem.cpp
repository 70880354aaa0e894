// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/refinement_problem.hpp"

namespace swiftlet {

WallsByStorey RefinementProblem::walls_at(const std::vector<Pose2>& T_map_body, double radius_m,
                                          std::span<const TraversalPoint> others_thinned,
                                          StoreyId storey_of_others) const {
  std::vector<WallMap> maps;
  std::vector<TraversalPoint> points;
  points.reserve(returns_.size());
  for (std::size_t i = 0; i <= index_of(std::max(highest_, storey_of_others)); ++i) {
    const auto storey = make_id<StoreyId>(i);
    points.clear();
    for (const PlacedReturn& r : returns_)
      if (!r.held_out && r.storey == storey)
        points.push_back({T_map_body[index_of(r.pose)] * r.p_body, r.traversal});
    maps.emplace_back(storey == storey_of_others ? others_thinned : std::span<const TraversalPoint>(), points,
                      radius_m, tuning_);
  }
  return WallsByStorey(std::move(maps));
}

double RefinementProblem::held_out_error_m(const WallsByStorey& walls,
                                           const std::vector<Pose2>& T_map_body) const {
  double sum_m = 0.0;
  std::size_t count = 0;
  for_held_out(walls, T_map_body, [&](std::uint32_t, double distance_m) {
    sum_m += distance_m;
    ++count;
  });
  return count == 0 ? 0.0 : sum_m / static_cast<double>(count);
}

}  // namespace swiftlet
