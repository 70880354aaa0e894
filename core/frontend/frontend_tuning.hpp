// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

#include "core/geometry/angle.hpp"
#include "core/sensing/multiscan.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

// Constants of the frontend's algorithms that no configuration file sets: results should hardly depend on
// them.

struct LineExtractorTuning {
  double merge_distance_share =
      0.5;  ///< of the split distance: end points farther off their joint line stay apart
};

/// Levenberg-Marquardt.
struct LandmarkGraphSolverTuning {
  double first_damping = 1e-5;
  double max_damping = 1e6;
  double damping_after_failure = 10.0;  ///< factor
  double damping_after_success = 0.1;   ///< factor
  double settled = 1e-4;                ///< relative decrease of F that ends the search
};

struct OdometryDriftTuning {
  double wander_share = 0.025;  ///< how much the drift changes a motion, as a share of its standard deviation
  double wall_sigma_rad = radians(1.0);  ///< walls that err together for a whole window make the graph's
                                         ///< estimates err together
  std::size_t lag_keyframes =
      3;  ///< estimated from the motion this many keyframes back, which later ones have corrected
};

struct BuildingAxisTuning {
  double gate_sigmas = 3.0;
  double max_gate_rad = radians(20);     ///< nearer to the middle between two axes a wall belongs to either
  double wall_sigma_rad = radians(2.5);  ///< of a wall that does run along the axis
  double robust_sigmas = 2.0;            ///< Geman-McClure: walls farther off lose their weight
  double keyframes_in_window = 10.0;     ///< a wall is estimated again at about so many keyframes
  double min_sigma_rad = radians(0.3);
  int other_axis_keyframes = 24;  ///< in a row, until another axis replaces the present one
  WallAxisTuning walls;
};

struct FrontendTuning {
  MultiscanTuning multiscan;
  LineExtractorTuning lines;
  LandmarkGraphSolverTuning solver;
  OdometryDriftTuning drift;
  BuildingAxisTuning axis;
};

}  // namespace swiftlet
