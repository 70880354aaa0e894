// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>

namespace swiftlet {

/// Constants of joint refinement that were chosen by results.
struct RefinementTuning {
  // Walls
  double radius_m = 0.3;          ///< a wall is fitted to points this close to a return
  double thinning_cell_m = 0.08;  ///< each traversal draws one point per cell
  std::size_t min_wall_points = 5;
  double min_wall_variance_m2 = 0.004;    ///< along the wall: shorter stretches have no direction
  double max_wall_variance_ratio = 0.35;  ///< across to along: more is clutter, not a wall

  // Point-to-line factors
  double wall_sigma_m = 0.05;
  double robust_sigmas = 1.5;  ///< scale of the Geman-McClure kernel

  // Held-out returns
  std::uint32_t hold_out_every = 10;
  double cap_sigmas = 3.0;  ///< of wall_sigma_m: greater distances count as this

  // Batch refinement
  double wide_radius_m = 0.5;  ///< instead of radius_m in the first iterations: walls may lie this far apart
  int wide_iterations = 5;
  double converged_step = 2e-4;  ///< metres or radians

  // Windows of the online refinement
  std::size_t max_window_returns = 3000;  ///< a window with more is thinned
  double step_weight = 0.25;              ///< on information: errors of dead reckoning persist, and add up
  double tie_sigma_m = 0.1;     ///< of each keyframe to its pose in the graph: poses that no wall holds
  double tie_sigma_rad = 0.05;  ///< return there
};

}  // namespace swiftlet
