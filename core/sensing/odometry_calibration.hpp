// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Systematic errors of dead reckoning, from a calibration: converts a measured motion to the true one. The
/// default changes nothing. Nothing here allocates.
struct OdometryCalibration {
  double forward_scale = 1.0;       ///< metres moved per metre measured, along the body's x
  double sideways_scale = 1.0;      ///< the same along its y
  double yaw_per_metre_rad = 0.0;   ///< yaw that is missed with each metre measured forward
  double yaw_per_radian = 0.0;      ///< share of each turn that is missed
  double yaw_per_second_rad = 0.0;  ///< yaw that is missed with each second in motion

  /// The true motion of a measured one, which took `elapsed`. No motion stays none: the vehicle stood still,
  /// or its odometry is frozen while it stands.
  [[nodiscard]] Pose2 corrected(const Pose2& T_previous_this, Duration elapsed) const {
    const double x_m = T_previous_this.x_m();
    const double y_m = T_previous_this.y_m();
    const double yaw_rad = T_previous_this.yaw_rad();
    if (x_m == 0.0 && y_m == 0.0 && yaw_rad == 0.0) return T_previous_this;
    return {forward_scale * x_m, sideways_scale * y_m,
            yaw_rad + yaw_per_metre_rad * x_m + yaw_per_radian * yaw_rad +
                yaw_per_second_rad * to_seconds(elapsed)};
  }
};

}  // namespace swiftlet
