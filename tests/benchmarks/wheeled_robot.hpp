// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/random.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// By how much dead reckoning errs. Each sigma is that of one metre or one radian: variances grow with the
/// way and the turn.
struct WheelErrors {
  double metre_scale = 1.0;
  double turn_scale = 1.0;
  double missed_yaw_per_metre_rad = 0.0;  ///< of the other sign in reverse: unequal wheels
  double way_sigma_m = 0.0;
  double yaw_sigma_by_way_rad = 0.0;
  double yaw_sigma_by_turn_rad = 0.0;
  double slips_per_metre = 0.0;
  double slip_sigma_rad = 0.0;
};

/// On the robot's axis, looking ahead over the half circle.
struct LaserScanner {
  std::size_t readings = 181;
  double rate_hz = 10.0;
  double max_range_m = 80.0;  ///< it reports no_return_m where it meets nothing nearer
  double no_return_m = 81.83;
  double range_sigma_m = 0.0;
  double stray_share = 0.0;  ///< of readings that are anything
  double lever_m = 0.0;      ///< ahead of the robot's middle
  double lag_s = 0.0;        ///< by which its ranges are older than the wheels' pose in the same line
};

struct WheeledRobot {
  double top_speed_m_per_s = 0.5;
  double top_turn_rad_per_s = 1.0;
  WheelErrors wheels;
  LaserScanner scanner;
};

/// How widely its errors are drawn is a choice: nobody measured them.
[[nodiscard]] WheeledRobot draw_robot(std::uint64_t seed);

inline constexpr double kDriveStepS = 0.01;

/// The true poses of the robot's middle, one each kDriveStepS, from the first waypoint to the last. It turns
/// on the spot where a waypoint lies far off its heading. On some of the legs with PilotHeading::kKeep it
/// drives in reverse. Spins are left out. Ends after half an hour. Precondition: two waypoints or more.
[[nodiscard]] std::vector<Pose2> drive(const WheeledRobot& robot, std::span<const Waypoint> way,
                                       NoiseSource& noise);

/// A log as CARMEN writes it, one FLASER line for each scan, and the true path of the laser, a line of TUM's
/// format for each.
struct RobotLog {
  std::string flaser;
  std::string truth;
};

/// Of walls that are as thick as that. `T_world_robot`: of drive().
[[nodiscard]] RobotLog log_drive(const WheeledRobot& robot, std::span<const Pose2> T_world_robot,
                                 std::span<const WallSegment> walls, double wall_thickness_m,
                                 NoiseSource& wheel_noise, NoiseSource& laser_noise);

}  // namespace swiftlet
