// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>

#include "core/frontend/frontend_tuning.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// The axis that the walls of a building share, in the frontend's local frame, estimated from the landmarks
/// in its window. A new wall near the axis most likely runs along it, and then gives the heading, which dead
/// reckoning alone loses at every corner. Similar to the heuristic drift elimination of Borenstein & Ojeda
/// 2010. Not in the paper.
/// @note Fixed storage. One thread at a time.
class BuildingAxis {
 public:
  explicit BuildingAxis(const BuildingAxisTuning& tuning = {}) : tuning_(tuning) {}

  struct Direction {
    double yaw_rad = 0.0;
    double information = 0.0;  ///< 1 / rad^2
  };

  /// The heading became uncertain by this much more.
  void turn(double yaw_variance_rad2) { heading_variance_rad2_ += yaw_variance_rad2; }
  /// The expected direction of a new wall observed along (or at right angles to) `yaw_rad`; nothing where
  /// that is too far from the axis.
  [[nodiscard]] std::optional<Direction> direction_near(double yaw_rad, double variance_rad2) const;
  /// Updates the axis from the present estimates of the walls in the window. A different axis replaces it
  /// after so many keyframes that the window has no other walls.
  void update(std::span<const WallDirection> walls);

 private:
  [[nodiscard]] double gate_rad(double variance_rad2) const;

  BuildingAxisTuning tuning_;
  std::optional<double> yaw_rad_;
  double variance_rad2_ = 0.0;          // of the axis
  double heading_variance_rad2_ = 0.0;  // of the heading against the axis
  int other_axis_ = 0;                  // keyframes whose walls agreed on another one, since the last on this
};

}  // namespace swiftlet
