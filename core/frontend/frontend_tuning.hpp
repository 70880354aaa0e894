// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

#include "core/base/tuning.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/multiscan.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

struct LineExtractorTuning {
  double merge_distance_share =
      0.5;  ///< of the split distance: end points farther off their joint line stay apart

  static constexpr TuningValue<LineExtractorTuning> kValues[] = {
      {"merge_distance_share", &LineExtractorTuning::merge_distance_share}};
};

/// Levenberg-Marquardt.
struct LandmarkGraphSolverTuning {
  double first_damping = 1e-5;   ///< at the first step
  double damping_factor = 10.0;  ///< after a step that failed; after one that did not, its inverse
  double settled = 1e-4;         ///< relative decrease of F that ends the search

  static constexpr TuningValue<LandmarkGraphSolverTuning> kValues[] = {
      {"first_damping", &LandmarkGraphSolverTuning::first_damping},
      {"damping_factor", &LandmarkGraphSolverTuning::damping_factor},
      {"settled", &LandmarkGraphSolverTuning::settled}};
};

struct OdometryDriftTuning {
  double wander_share = 0.025;  ///< how much the drift changes a motion, as a share of its standard deviation
  double wall_sigma_rad = radians(1.0);  ///< walls that err together for a whole window make the graph's
                                         ///< estimates err together
  std::size_t lag_keyframes =
      3;  ///< estimated from the motion this many keyframes back, which later ones have corrected

  static constexpr TuningValue<OdometryDriftTuning> kValues[] = {
      {"wander_share", &OdometryDriftTuning::wander_share},
      {"wall_sigma_rad", &OdometryDriftTuning::wall_sigma_rad},
      {"lag_keyframes", &OdometryDriftTuning::lag_keyframes}};
};

struct BuildingAxisTuning {
  double gate_sigmas = 3.0;             ///< between a wall and the axis that it may run along
  double max_gate_rad = radians(20);    ///< nearer to the middle between two axes a wall belongs to either
  double robust_sigmas = 2.0;           ///< Geman-McClure: walls farther off lose their weight
  double keyframes_in_window = 10.0;    ///< a wall is estimated again at about so many keyframes
  double min_sigma_rad = radians(0.3);  ///< of the axis
  int other_axis_keyframes = 24;        ///< that agree on another axis, until that replaces the present one
  WallAxisTuning walls;

  static constexpr TuningValue<BuildingAxisTuning> kValues[] = {
      {"gate_sigmas", &BuildingAxisTuning::gate_sigmas},
      {"max_gate_rad", &BuildingAxisTuning::max_gate_rad},
      {"robust_sigmas", &BuildingAxisTuning::robust_sigmas},
      {"keyframes_in_window", &BuildingAxisTuning::keyframes_in_window},
      {"min_sigma_rad", &BuildingAxisTuning::min_sigma_rad},
      {"other_axis_keyframes", &BuildingAxisTuning::other_axis_keyframes}};
};

struct FrontendTuning {
  MultiscanTuning multiscan;
  LineExtractorTuning lines;
  LandmarkGraphSolverTuning solver;
  OdometryDriftTuning drift;
  BuildingAxisTuning axis;
};

}  // namespace swiftlet
