// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/benchmarks/wheeled_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/laser_log/carmen_log.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

constexpr double kWallM = 0.2;
constexpr double kDigitM = 0.005;  // of a reading

/// Along x, round a corner and back, in a room.
class WheeledRobotTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<Pose2> driven() const {
    NoiseSource noise(1, "driver");
    return drive(robot_, way_, noise);
  }
  [[nodiscard]] RobotLog logged(const std::vector<Pose2>& T_world_robot) const {
    NoiseSource wheels(1, "wheels");
    NoiseSource laser(1, "laser");
    return log_drive(robot_, T_world_robot, walls_, kWallM, wheels, laser);
  }
  /// With three beams: right, ahead, left.
  [[nodiscard]] CarmenLog read(const std::vector<Pose2>& T_world_robot) const {
    file_.write(logged(T_world_robot).flaser);
    Result<CarmenLog> log = read_carmen_log(file_.path(), 3);
    EXPECT_TRUE(log) << log.error().message;
    return std::move(log).value();
  }
  /// Of each scan the nearest step.
  [[nodiscard]] std::size_t step_of(std::size_t scan) const {
    return static_cast<std::size_t>(
        std::lround(static_cast<double>(scan) / robot_.scanner.rate_hz / kDriveStepS));
  }

  WheeledRobot robot_;  // without errors
  const std::vector<Waypoint> way_{{{0.0, 0.0}}, {{4.0, 0.0}}, {{4.0, 3.0}}, {{0.0, 0.0}}};
  const std::vector<WallSegment> walls_{{{-3.0, -2.0}, {7.0, -2.0}},
                                        {{7.0, -2.0}, {7.0, 6.0}},
                                        {{7.0, 6.0}, {-3.0, 6.0}},
                                        {{-3.0, 6.0}, {-3.0, -2.0}}};
  TemporaryFile file_{"robot.clf"};
};

TEST_F(WheeledRobotTest, DrivesFromOneWaypointToTheNext) {
  const std::vector<Pose2> path = driven();
  for (const Waypoint& waypoint : way_)
    EXPECT_TRUE(std::ranges::any_of(
        path, [&](const Pose2& T) { return distance_m(T.position(), waypoint.position) < 0.15; }));
  EXPECT_LT(distance_m(path.back().position(), way_.back().position), 0.15);
  for (std::size_t i = 1; i < path.size(); ++i)
    ASSERT_LE(distance_m(path[i].position(), path[i - 1].position()),
              1.001 * robot_.top_speed_m_per_s * kDriveStepS);
}

TEST_F(WheeledRobotTest, WithoutErrorsTheWheelsMeasureThePathOfTheLaser) {
  robot_.scanner.lever_m = 0.25;
  const std::vector<Pose2> path = driven();
  const CarmenLog log = read(path);
  const Pose2 T_robot_laser(0.25, 0.0, 0.0);
  const Pose2 T_world_odom = path.front();
  ASSERT_EQ(log.scans.size(), path.size() / 10 + 1);
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const Pose2 T_odom_laser(log.scans[i].position.x_m, log.scans[i].position.y_m, log.scans[i].yaw_rad);
    ASSERT_TRUE(poses_near(T_world_odom * T_odom_laser, path[step_of(i)] * T_robot_laser, 0.02, 1e-5)) << i;
  }
}

TEST_F(WheeledRobotTest, RangesEndAtTheFacesOfTheWalls) {
  const std::vector<Pose2> still(20, Pose2(1.0, 0.5, 0.0));
  const CarmenLog log = read(still);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_NEAR(log.distances_of(1)[0], 2.5 - kWallM / 2.0, kDigitM);
  EXPECT_NEAR(log.distances_of(1)[1], 6.0 - kWallM / 2.0, kDigitM);
  EXPECT_NEAR(log.distances_of(1)[2], 5.5 - kWallM / 2.0, kDigitM);
}

TEST_F(WheeledRobotTest, WhatLiesBeyondReachIsNoReturn) {
  robot_.scanner.max_range_m = 3.0;
  robot_.scanner.no_return_m = 3.5;
  const CarmenLog log = read(std::vector<Pose2>(5, Pose2(1.0, 0.5, 0.0)));
  EXPECT_NEAR(log.distances_of(0)[0], 2.4, kDigitM);
  EXPECT_NEAR(log.distances_of(0)[1], 3.5, kDigitM);
}

TEST_F(WheeledRobotTest, RangesMayLagBehindTheWheels) {
  const std::vector<Pose2> path = driven();
  const CarmenLog timely = read(path);
  robot_.scanner.lag_s = 0.1;  // one scan
  const CarmenLog late = read(path);
  ASSERT_EQ(late.scans.size(), timely.scans.size());
  for (std::size_t i = 1; i < late.scans.size(); ++i) {
    ASSERT_EQ(late.distances_of(i)[1], timely.distances_of(i - 1)[1]) << i;
    ASSERT_EQ(late.scans[i].position.x_m, timely.scans[i].position.x_m) << i;
  }
}

TEST_F(WheeledRobotTest, WheelsMayMeasureMetresAndTurnsTooLong) {
  robot_.wheels.metre_scale = 1.1;
  robot_.wheels.turn_scale = 1.05;
  const std::vector<Pose2> path = driven();
  const CarmenLog log = read(path);
  const std::size_t corner = 50;  // still on the way along x
  EXPECT_NEAR(log.scans[corner].position.x_m, 1.1 * path[step_of(corner)].x_m(), 0.01);
  const double turned_rad = path.back().yaw_rad() + 2.0 * kPi;  // by 217 degrees to the left
  EXPECT_NEAR(wrap_angle(log.scans.back().yaw_rad - 1.05 * turned_rad), 0.0, 0.02);
}

TEST_F(WheeledRobotTest, UnequalWheelsTurnTheOtherWayInReverse) {
  robot_.wheels.missed_yaw_per_metre_rad = 0.1;
  std::vector<Pose2> there_and_back;
  for (int i = 0; i <= 400; ++i) there_and_back.emplace_back(0.005 * i, 0.0, 0.0);
  for (int i = 400; i >= 0; --i) there_and_back.emplace_back(0.005 * i, 0.0, 0.0);
  const CarmenLog log = read(there_and_back);
  EXPECT_NEAR(log.scans[40].yaw_rad, 0.2, 0.01);
  EXPECT_NEAR(log.scans.back().yaw_rad, 0.0, 0.01);
}

TEST_F(WheeledRobotTest, ASeedIsARobotAndItsDrive) {
  robot_ = draw_robot(3);
  const RobotLog log = logged(driven());
  EXPECT_EQ(log.flaser, logged(driven()).flaser);
  EXPECT_EQ(log.truth, logged(driven()).truth);
  EXPECT_NE(draw_robot(4).wheels.metre_scale, robot_.wheels.metre_scale);
}

}  // namespace
}  // namespace swiftlet
