// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/random.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// The standard deviation of readings at a distance; in between, linear.
struct NoiseAtRange {
  double distance_m = 0.0;
  double sigma_m = 0.0;
};

/// A VL53L1x indoors: ST datasheet DocID031281 (limits) and what the reference flights show (noise, cone).
struct RangerModel {
  /// In effect, by how far short the reference flights read oblique walls
  /// (tests/benchmarks/oblique_returns.cpp). The field of view is 27 degrees, but what is off its middle
  /// hardly counts.
  double half_cone_rad = radians(5.0);
  double noise_floor_m = 0.01;  ///< standard deviation = floor + share * distance
  double noise_share = 0.01;
  double max_range_m = 3.6;     ///< nothing is received from farther away
  double half_lost_at_m = 3.0;  ///< squarely met walls at this distance are missed every other time...
  double lost_within_m = 0.2;   ///< ...and the share lost rises from 12 to 88 % within 2 of these around it
  double lost_anyway = 0.003;   ///< share of readings that fail for no visible reason
  double dark_share = 0.3;      ///< of the light of a plain wall that a dark one sends back
  std::vector<NoiseAtRange> noise_by_range;  ///< ascending; where given, instead of floor and share
  double wild_share = 0.0;     ///< of the readings that err by more than three standard deviations
  double phantom_share = 0.0;  ///< of the readings beyond kPhantomsFromM that show nothing that is there
};
inline constexpr double kPhantomsFromM = 3.0;

/// The return of the whole cone, before noise.
struct ConeReturn {
  double distance_m = 0.0;
  /// The distance at which a wall that is met squarely and fills the cone returns as little light: grows with
  /// distance, with incidence, and where the target fills the cone only in part.
  double dimness_m = 0.0;
};

/// The light that a wall at that pose returns into the cone around `direction_rad` (world frame); nullopt if
/// nothing is within the range limit. The sensor times one pulse: returns that lie closely behind the nearest
/// merge into it, weighted by the light they send back, those farther behind are hidden by it.
[[nodiscard]] std::optional<ConeReturn> look_through_cone(std::span<const WallSegment> walls,
                                                          const Point2& origin, double direction_rad,
                                                          const RangerModel& model);

/// One reading in metres; nullopt when the sensor reports it as not valid.
[[nodiscard]] std::optional<double> measure_range(std::span<const WallSegment> walls, const Point2& origin,
                                                  double direction_rad, const RangerModel& model,
                                                  NoiseSource& noise);

/// The same reading as the firmware's range log variables show it: whole millimetres, 32766 when not valid.
[[nodiscard]] double logged_range_mm(std::optional<double> range_m);

}  // namespace swiftlet
