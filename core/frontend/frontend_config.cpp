// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend_config.hpp"

#include <cmath>

#include "core/sensing/keyframe.hpp"
#include "core/sensing/multiscan.hpp"

namespace swiftlet {
namespace {

using Problems = std::vector<std::string>;

void require(bool holds, const char* field, const std::string& rule, Problems& problems) {
  if (!holds) problems.push_back(std::string("frontend.") + field + " must be " + rule);
}
void require_positive(double value, const char* field, Problems& problems) {
  require(value > 0.0 && std::isfinite(value), field, "above 0 and finite", problems);
}
void require_within(int value, int low, int high, const char* field, Problems& problems) {
  require(value >= low && value <= high, field,
          "between " + std::to_string(low) + " and " + std::to_string(high), problems);
}

}  // namespace

std::vector<std::string> FrontendConfig::validate() const {
  constexpr int kMaxPoints = static_cast<int>(kMaxMultiscanPoints - kMaxBeams);
  Problems problems;
  require_positive(keyframe_distance_m, "keyframe_distance_m", problems);
  require_positive(keyframe_turn_rad, "keyframe_turn_rad", problems);
  require_within(multiscan_points, 8, kMaxPoints, "multiscan_points", problems);
  require_positive(split_distance_m, "split_distance_m", problems);
  require_positive(max_point_gap_m, "max_point_gap_m", problems);
  require_within(min_line_points, 3, kMaxPoints, "min_line_points", problems);
  require_positive(min_line_length_m, "min_line_length_m", problems);
  require_positive(max_line_rms_m, "max_line_rms_m", problems);
  require(min_incidence_rad >= 0.0 && min_incidence_rad < 0.5 * kPi, "min_incidence_rad",
          "at least 0 and below pi/2", problems);
  require_positive(wall_sigma_m, "wall_sigma_m", problems);
  require_positive(wall_sigma_rad, "wall_sigma_rad", problems);
  require_positive(association_error_m, "association_error_m", problems);
  require(association_gap_m >= 0.0 && std::isfinite(association_gap_m), "association_gap_m",
          "0 or more and finite", problems);
  require_positive(association_mahalanobis2, "association_mahalanobis2", problems);
  require_within(window_keyframes, 2, static_cast<int>(kMaxKeyframeWindow), "window_keyframes", problems);
  require(association_keyframes >= 1 && association_keyframes <= window_keyframes, "association_keyframes",
          "at least 1 and at most window_keyframes", problems);
  require_within(solver_iterations, 1, 100, "solver_iterations", problems);
  require(chi_square_confidence > 0.0 && chi_square_confidence < 1.0, "chi_square_confidence",
          "between 0 and 1, both excluded", problems);
  return problems;
}

}  // namespace swiftlet
