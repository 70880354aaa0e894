// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// What dead reckoning errs beyond its noise model, as a random walk: floors of which a flow sensor sees a
/// part, wheels that slip, a sign that is lost. Rare and large: a model that had them in every step would
/// leave the graph without motion.
struct SlipNoise {
  double along_m2_per_m = 0.0;  ///< variance along each metre of way
  double yaw_rad2_per_m = 0.0;  ///< variance of the heading with each metre

  /// Of a motion as (x, y, yaw), in the frame it starts from.
  [[nodiscard]] Eigen::Matrix3d covariance(const Pose2& T_from_to) const {
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
    const Eigen::Vector2d way(T_from_to.x_m(), T_from_to.y_m());
    const double length_m = way.norm();
    if (length_m <= 0.0) return P;
    P.topLeftCorner<2, 2>() = along_m2_per_m / length_m * way * way.transpose();
    P(2, 2) = yaw_rad2_per_m * length_m;
    return P;
  }
};

}  // namespace swiftlet
