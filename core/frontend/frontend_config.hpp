// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/frontend/frontend_tuning.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/multiscan.hpp"

namespace swiftlet {

/// Settings of the landmark graph (Algorithm 1). One set serves all places and sensors.
struct FrontendConfig {
  bool use_landmarks = true;
  double keyframe_distance_m = 0.5;
  double keyframe_turn_rad = radians(30);
  int multiscan_points = 120;

  // Line extraction
  double split_distance_m = 0.10;
  double max_point_gap_m = 0.8;
  int min_line_points = 5;
  double min_line_length_m = 0.5;
  double max_line_rms_m = 0.04;
  double min_incidence_rad = radians(20);
  double wall_sigma_m = 0.03;
  double wall_sigma_rad = radians(2);

  // Association
  double association_error_m = 0.35;
  double association_gap_m = 0.0;
  double association_mahalanobis2 = 9.2;  // 99 %
  int association_keyframes = 16;

  // Landmark graph
  bool align_to_walls = true;
  int window_keyframes = 24;
  int solver_iterations = 10;
  double chi_square_confidence = 0.95;

  static constexpr SettingsSection kSection{"frontend", "The landmark graph: one step for each sample."};
  static constexpr Setting<FrontendConfig> kSettings[] = {
      {"use_landmarks", &FrontendConfig::use_landmarks, "", "false: dead reckoning only, a baseline"},
      {"keyframe_distance_m", &FrontendConfig::keyframe_distance_m, "m",
       "a keyframe once the vehicle is this far away from the last one", 0.01, 10},
      {"keyframe_turn_rad", &FrontendConfig::keyframe_turn_rad, "rad",
       "a keyframe once the vehicle is turned by this much against the last one", 0.01, 3.2},
      {"multiscan_points", &FrontendConfig::multiscan_points, "",
       "k scans are seen together, k = this / beams, rounded up, at least 2", 8,
       kMaxMultiscanPoints - kMaxBeams},
      {"split_distance_m", &FrontendConfig::split_distance_m, "m",
       "a point farther than this from the chord splits a segment", 0.001, 2},
      {"max_point_gap_m", &FrontendConfig::max_point_gap_m, "m",
       "neighbours along a line farther apart than this are not one wall", 0.01, 10},
      {"min_line_points", &FrontendConfig::min_line_points, "", "fewer points make no line", 3,
       kMaxMultiscanPoints - kMaxBeams},
      {"min_line_length_m", &FrontendConfig::min_line_length_m, "m", "shorter segments are not used", 0.01,
       10},
      {"max_line_rms_m", &FrontendConfig::max_line_rms_m, "m",
       "points scattered wider than this around their line make none", 0.001, 1},
      {"min_incidence_rad", &FrontendConfig::min_incidence_rad, "rad",
       "lines that the beams meet at a flatter angle, in the mean, are none", 0, 1.57},
      {"wall_sigma_m", &FrontendConfig::wall_sigma_m, "m",
       "walls are not ideal lines: added to the error of their distance", 0.0001, 1},
      {"wall_sigma_rad", &FrontendConfig::wall_sigma_rad, "rad",
       "walls are not ideal lines: added to the error of their direction", 0.0001, 1},
      {"association_error_m", &FrontendConfig::association_error_m, "m",
       "summed distance of both end points from the landmark (epsilon of eq. 5)", 0.001, 5},
      {"association_gap_m", &FrontendConfig::association_gap_m, "m",
       "how far two segments may miss each other and still overlap (eq. 8)", 0, 10},
      {"association_mahalanobis2", &FrontendConfig::association_mahalanobis2, "",
       "squared Mahalanobis distance of the lines at most (2 degrees of freedom)", 0.01, 1000},
      {"association_keyframes", &FrontendConfig::association_keyframes, "",
       "a landmark not seen within this many keyframes is not associated; at most window_keyframes", 1,
       kMaxKeyframeWindow},
      {"align_to_walls", &FrontendConfig::align_to_walls, "",
       "new walls run along the axis that a building's walls share"},
      {"window_keyframes", &FrontendConfig::window_keyframes, "", "keyframes optimised at once (fixed lag)",
       2, kMaxKeyframeWindow},
      {"solver_iterations", &FrontendConfig::solver_iterations, "", "Levenberg-Marquardt steps at most", 1,
       100},
      {"chi_square_confidence", &FrontendConfig::chi_square_confidence, "",
       "confidence of the consistency check (eq. 19)", 0.5, 0.999999},
  };

  FrontendTuning tuning;  ///< no setting: for experiments

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace swiftlet
