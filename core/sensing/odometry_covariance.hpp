// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/base/time.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// First-order error propagation of dead reckoning: eq. (14) of "Efficient 2D Graph SLAM for Sparse Sensing"
/// (Zhou, Hu, Liu, Khan; IROS 2022), after Smith, Self & Cheeseman 1990. Nothing here allocates.
struct UncertainMotion {
  Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of T_from_to as (x, y, yaw): m^2, m rad, rad^2
};

/// Standard deviations of a motion of dead reckoning.
struct OdometrySigma {
  double xy_m = 0.0;
  double yaw_rad = 0.0;

  /// Of the motion as (x, y, yaw): diagonal.
  [[nodiscard]] Eigen::Matrix3d covariance() const {
    return Eigen::Vector3d(xy_m * xy_m, xy_m * xy_m, yaw_rad * yaw_rad).asDiagonal();
  }
  /// The diagonal of its inverse.
  [[nodiscard]] Eigen::Vector3d information() const {
    return {1.0 / (xy_m * xy_m), 1.0 / (xy_m * xy_m), 1.0 / (yaw_rad * yaw_rad)};
  }
};
/// As OdometryNoise gives them, of a motion that took `duration`; less than a millisecond counts as one.
OdometrySigma odometry_sigma(const OdometryNoise& noise, const Pose2& motion, Duration duration);

/// Of a motion that was neither measured nor guessed: anywhere in a building, any heading. Weak enough that
/// it decides nothing, strong enough that every system of equations stays solvable.
inline constexpr OdometrySigma kUnknownMotion{100.0, 10.0};

/// Of a vehicle whose estimate restarted: most stood still meanwhile, or were started again where they had
/// landed. One that was carried contradicts it.
inline constexpr OdometrySigma kStoodStill{0.4, radians(10.0)};

/// One step of dead reckoning, which took `duration`, with its error; exactly no motion has none (the vehicle
/// stood still).
UncertainMotion uncertain_step(const OdometryNoise& noise, const Pose2& T_previous_this, Duration duration);

/// A step of dead reckoning over a silence: the vehicle moved from one end to the other on an unknown path.
/// The error of an assumed detour, which grows with the silence, is added.
UncertainMotion unwatched_step(const OdometryNoise& noise, const Pose2& T_previous_this, Duration silence);

/// T_a_b then T_b_c, their errors independent of one another.
UncertainMotion operator*(const UncertainMotion& T_a_b, const UncertainMotion& T_b_c);

}  // namespace swiftlet
