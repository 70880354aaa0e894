// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <optional>

#include "firmware_link/sample/attitude.hpp"

namespace swiftlet {

/// Of a tilt at the moment of measurement: it is logged ten times a second, and gusts are faster. The 160
/// returns of the flight olsson, half a metre high, that tilt sends to the floor within 3 m scatter by a
/// quarter in distance.
inline constexpr double kTiltSigmaRad = 0.044;

/// A Crazyflie that is not higher than this above what is below it stands there, level: its ranger stands
/// some 3 cm high, and the usual take-off ends at 0.3 m. From so low its beams, cones of 27 degrees, meet
/// what is below within 0.1 m / tan(13.5 degrees) = 0.4 m, be it the floor or the top of a box that it flies
/// over: on the flight rice the front reads 0.22 m on the ground, and 2.8 m in the air.
inline constexpr double kStandingM = 0.1;

/// How far the unit vector along a beam points up.
inline double rise_of_beam(double bearing_rad, const BodyTilt& tilt) {
  return std::cos(bearing_rad) * tilt.x_up + std::sin(bearing_rad) * tilt.y_up;
}

/// The horizontal distance to what a beam of a tilted body met `range_m` away. The change of its bearing is
/// of second order in the tilt, and left out.
inline double level_range_m(double range_m, double rise) { return range_m * std::sqrt(1.0 - rise * rise); }

/// Whether a beam from `height_m` above the floor can have met the floor `range_m` away: if it points down by
/// one kTiltSigmaRad more than it seems to.
inline bool can_be_floor(double range_m, double rise, double height_m) {
  return range_m * (kTiltSigmaRad - rise) >= height_m;
}

}  // namespace swiftlet
