// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/geometry/angle.hpp"

namespace swiftlet {

/// No search for a loop is narrower than this to either side: covariances of motion are models.
inline constexpr double kMinSearchAngleRad = 0.1;

/// Settings of submaps, loop closing and the pose graph (Algorithm 3). One set serves all places and sensors.
struct BackendConfig {
  // Submaps
  double submap_length_m = 6.0;    ///< a submap covers this much travel
  double grid_resolution_m = 0.1;  ///< cell size of submaps
  double hit_probability = 0.62;   ///< p(occupied | a beam ended here)
  double miss_probability = 0.45;  ///< p(occupied | a beam passed through)
  int max_kernel_cells = 3;        ///< width of the max kernel (eq. 22); 1 is eq. 21, no kernel

  // Loop closing
  bool close_loops = true;                ///< false: the frontend alone, a baseline
  double multiscan_length_m = 6.0;        ///< the recent travel that is matched against submaps
  int match_every_keyframes = 2;          ///< look for loops at every n-th keyframe
  double min_travel_between_m = 12.0;     ///< travel between the two ends of a closure
  double search_radius_m = 8.0;           ///< widest search around the predicted position
  double search_angle_rad = radians(30);  ///< widest search around the predicted heading
  int max_candidates = 8;        ///< submaps searched per keyframe at most, the most overlapping first
  double min_score = 0.5;        ///< mean probability under the scan's points that makes a closure
  double min_group_score = 0.4;  ///< ... that makes one together with others that agree
  int min_match_points = 30;     ///< fewer points decide nothing

  // Pose graph
  bool align_to_walls = true;     ///< hold the heading by the axis that a building's walls share
  double dcs_phi = 5.0;           ///< DCS: closures whose chi-square exceeds this are scaled down
  double drop_scale = 0.1;        ///< closures scaled below this in the final pass are dropped
  int optimizer_iterations = 20;  ///< Gauss-Newton steps at most; while flying never more than 4 a keyframe

  // Joint refinement
  bool refine = true;  ///< false: poses between keyframes stay interpolated, while flying and at the end
  int refinement_iterations = 25;  ///< rounds of walls and poses at most, at the end

  // Known space
  int max_scans =
      20000;  ///< with more than these, what others know as well is forgotten: 33 minutes at 10 Hz

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace swiftlet
