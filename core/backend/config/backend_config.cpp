// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/config/backend_config.hpp"

#include <cmath>

namespace swiftlet {

std::vector<std::string> BackendConfig::validate() const {
  std::vector<std::string> problems;
  const auto require = [&](bool good, const char* what) {
    if (!good) problems.emplace_back(what);
  };
  const auto is_positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(is_positive(submap_length_m), "backend.submap_length_m must be above 0 and finite");
  require(grid_resolution_m >= 0.01 && grid_resolution_m <= 1.0,
          "backend.grid_resolution_m must lie in 0.01..1");
  require(hit_probability > 0.5 && hit_probability < 1.0,
          "backend.hit_probability must lie between 0.5 and 1");
  require(miss_probability > 0.0 && miss_probability < 0.5,
          "backend.miss_probability must lie between 0 and 0.5");
  require(max_kernel_cells >= 1 && max_kernel_cells <= 15 && max_kernel_cells % 2 == 1,
          "backend.max_kernel_cells must be odd, 1..15");
  require(is_positive(multiscan_length_m), "backend.multiscan_length_m must be above 0 and finite");
  require(match_every_keyframes >= 1, "backend.match_every_keyframes must be at least 1");
  require(min_travel_between_m >= 0.0 && std::isfinite(min_travel_between_m),
          "backend.min_travel_between_m must be 0 or more and finite");
  require(search_radius_m > 0.0 && search_radius_m <= 50.0, "backend.search_radius_m must lie in 0..50");
  static_assert(kMinSearchAngleRad == 0.1, "the message says so");
  require(search_angle_rad >= kMinSearchAngleRad && search_angle_rad <= kPi,
          "backend.search_angle_rad must lie in 0.1..pi");
  require(max_candidates >= 1, "backend.max_candidates must be at least 1");
  require(min_score > 0.0 && min_score < 1.0, "backend.min_score must lie between 0 and 1");
  require(min_group_score > 0.0 && min_group_score < 1.0, "backend.min_group_score must lie between 0 and 1");
  require(min_match_points >= 3, "backend.min_match_points must be at least 3");
  require(is_positive(dcs_phi), "backend.dcs_phi must be above 0 and finite");
  require(drop_scale >= 0.0 && drop_scale < 1.0, "backend.drop_scale must lie in 0..1");
  require(optimizer_iterations >= 1, "backend.optimizer_iterations must be at least 1");
  require(refinement_iterations >= 1, "backend.refinement_iterations must be at least 1");
  require(max_scans >= 1000, "backend.max_scans must be at least 1000");
  return problems;
}

}  // namespace swiftlet
