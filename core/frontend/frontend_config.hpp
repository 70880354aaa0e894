// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/geometry/angle.hpp"

namespace swiftlet {

/// Settings of the landmark graph (Algorithm 1). One set serves all places and sensors.
struct FrontendConfig {
  bool use_landmarks = true;               ///< false: dead reckoning only, a baseline
  double keyframe_distance_m = 0.5;        ///< a keyframe after this much travel ...
  double keyframe_turn_rad = radians(30);  ///< ... or this much turning
  int multiscan_points = 120;              ///< k scans are seen together, k = ceil(this / beams), at least 2

  // Line extraction
  double split_distance_m = 0.10;  ///< a point farther than this from the chord splits a segment
  double max_point_gap_m = 0.8;    ///< neighbours along a line farther apart than this are not one wall
  int min_line_points = 5;         ///< fewer points make no line
  double min_line_length_m = 0.5;  ///< shorter segments are not used
  double max_line_rms_m = 0.04;    ///< points scattered wider than this around their line make none
  double min_incidence_rad =
      radians(20);             ///< lines that the beams meet at a flatter angle, in the mean, are none
  double wall_sigma_m = 0.03;  ///< walls are not ideal lines: added to the error of rho ...
  double wall_sigma_rad = radians(2);  ///< ... and of alpha

  // Association
  double association_error_m = 0.35;  ///< epsilon of eq. 5: summed distance of both end points from the wall
  double association_gap_m = 0.0;     ///< how far two segments may miss each other and still overlap (eq. 8)
  double association_mahalanobis2 = 9.2;  ///< squared Mahalanobis distance of the lines at most (2 dof, 99 %)
  int association_keyframes = 16;         ///< a wall not seen within this many keyframes is not associated

  // Landmark graph
  bool align_to_walls = true;           ///< new walls run along the axis that a building's walls share
  int window_keyframes = 24;            ///< fixed lag; at most kMaxKeyframeWindow
  int solver_iterations = 10;           ///< Levenberg-Marquardt steps at most
  double chi_square_confidence = 0.95;  ///< of eq. 19

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace swiftlet
