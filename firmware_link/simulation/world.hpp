// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

enum class WallSurface : std::uint8_t {
  kPlain,
  kDark,   ///< sends little light back
  kGlass,  ///< seen only when met squarely; else what stands behind it is
};

/// A straight, infinitely thin wall from floor to ceiling, in the world frame.
struct WallSegment {
  Point2 start;
  Point2 end;
  WallSurface surface = WallSurface::kPlain;
};

/// A round part of the floor on which the flow sensor measures that share of the motion.
struct FloorPatch {
  Point2 centre;
  double radius_m = 0.0;
  double seen_share = 1.0;
};

enum class PilotHeading : std::uint8_t {
  kIntoTravel,  ///< turns the nose into the direction of travel
  kKeep,        ///< keeps the nose where it points: flies sideways or backwards
};

/// One leg of a flight: how to get to `position` and what to do there. Between two storeys the leg is a
/// straight flight of stairs, a metre long or more.
struct Waypoint {
  Point2 position;
  PilotHeading heading = PilotHeading::kIntoTravel;
  double spin_rad = 0.0;  ///< on arrival the pilot stops and looks around by this much, left positive
  double hover_s = 0.0;   ///< ... and then stays for this long
  int storey = 0;         ///< on which floor of the building: 0 the lowest
};

/// Rooms and the flight through them. The first waypoint is where the vehicle stands before take-off, its
/// nose towards the second.
struct SimulatedWorld {
  std::vector<WallSegment> walls;  ///< of storey 0
  std::vector<Waypoint> flight;
  std::vector<FloorPatch> floor_patches = {};
  /// Of a building drawn at random, whose vehicle has errors drawn at random, too; else empty.
  std::string_view kind = {};
  std::vector<std::vector<WallSegment>> upper_walls = {};  ///< of storey 1, 2, ...
  double storey_height_m = 3.2;                            ///< from floor to floor

  /// Those around a vehicle above ground of that elevation, relative to storey 0: of the nearest storey.
  [[nodiscard]] std::span<const WallSegment> walls_at(double ground_m) const;
};

/// A world that can be chosen: one row of the table in floor_plans.cpp, from which all else about it derives.
struct WorldPlan {
  std::string_view name;
  std::string_view text;  ///< what it is, for help
  SimulatedWorld (*make)(std::uint64_t seed) = nullptr;
};
[[nodiscard]] std::span<const WorldPlan> simulated_worlds();
/// "office, maze, loop"
[[nodiscard]] std::string simulated_world_names();

/// The world of that name; the seed decides those that are drawn at random. kNotFound: no such world; the
/// message lists the worlds.
[[nodiscard]] Result<SimulatedWorld> make_simulated_world(std::string_view name, std::uint64_t seed = 1);

struct RayHit {
  double distance_m = 0.0;
  double cos_incidence = 1.0;  ///< between ray and wall normal: 1 when the ray meets the wall squarely
  WallSurface surface = WallSurface::kPlain;
};

/// The nearest wall along the ray from `origin`; nullopt when none lies within `max_distance_m`.
[[nodiscard]] std::optional<RayHit> cast_ray(std::span<const WallSegment> walls, const Point2& origin,
                                             double direction_rad, double max_distance_m);

/// Those of which a part may lie within that distance, in their order.
[[nodiscard]] std::vector<WallSegment> walls_near(std::span<const WallSegment> walls, const Point2& origin,
                                                  double distance_m);

}  // namespace swiftlet
