// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/landed_odometry_freeze.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"
#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

Reading reading_of(const Pose2& T_vehicle_body, std::optional<bool> is_flying) {
  Reading reading;
  reading.position_odom = T_vehicle_body.position();
  reading.yaw_odom_rad = T_vehicle_body.yaw_rad();
  reading.is_flying = is_flying;
  for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
  return reading;
}
Pose2 pose_of(const Reading& reading) {
  return {reading.position_odom->x_m, reading.position_odom->y_m, *reading.yaw_odom_rad};
}
void expect_pose(const Reading& reading, const Pose2& expected) {
  const Pose2 pose = pose_of(reading);
  EXPECT_NEAR(pose.x_m(), expected.x_m(), 1e-9);
  EXPECT_NEAR(pose.y_m(), expected.y_m(), 1e-9);
  EXPECT_NEAR(wrap_angle(pose.yaw_rad() - expected.yaw_rad()), 0.0, 1e-9);
}

/// One each 100 ms.
class Readings {
 public:
  Reading hold(const Pose2& T_vehicle_body, bool is_flying) {
    Reading reading = reading_of(T_vehicle_body, is_flying);
    reading.at = device_ms(ms_ += 100);
    return ground_.hold(reading);
  }

 private:
  LandedOdometryFreeze ground_;
  std::int64_t ms_ = 0;
};

TEST(LandedOdometryFreeze, DoesNotChangeAFlight) {
  LandedOdometryFreeze ground;
  expect_pose(ground.hold(reading_of({0.0, 0.0, 0.0}, false)), {0.0, 0.0, 0.0});
  const Reading flown = ground.hold(reading_of({3.0, 1.0, 2.0}, true));
  expect_pose(flown, {3.0, 1.0, 2.0});
  EXPECT_EQ(flown.distance_m[0], 1.F);
  EXPECT_FALSE(flown.odometry_restarted);
}

TEST(LandedOdometryFreeze, FreezesAfterLandingWhileTheYawIsPulledBackAndDropsTheRanges) {
  LandedOdometryFreeze ground;
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, 2.0}, true)));
  for (const double yaw_rad : {2.0, 1.8, 1.5, 1.0, 0.5, 0.2}) {
    const Reading held = ground.hold(reading_of({3.05, 1.02, yaw_rad}, false));
    expect_pose(held, {3.05, 1.02, 2.0});
    EXPECT_TRUE(std::isnan(held.distance_m[0]));
  }
}

/// What moves by a last bit would not count as standing: OdometryCalibration::corrected.
TEST(LandedOdometryFreeze, WhatStandsDoesNotMoveAtAll) {
  LandedOdometryFreeze ground;
  static_cast<void>(ground.hold(reading_of({2.7, 1.3, 2.0}, true)));
  const Pose2 landed = pose_of(ground.hold(reading_of({3.1, 1.7, 2.0}, false)));
  for (int i = 1; i < 50; ++i) {
    const Pose2 held = pose_of(ground.hold(reading_of({3.1 + 0.001 * i, 1.7, 2.0 - 0.03 * i}, false)));
    EXPECT_EQ(held.vector(), landed.vector()) << i;
  }
}

TEST(LandedOdometryFreeze, StandsBeforeItsFirstFlightTooButMayBeCarriedByHand) {
  LandedOdometryFreeze ground;
  const auto hold = [&ground](const Pose2& T_vehicle_body, double height_m, bool is_flying) {
    Reading reading = reading_of(T_vehicle_body, is_flying);
    reading.height_m = height_m;
    return ground.hold(reading);
  };
  expect_pose(hold({0.1, 0.0, 0.2}, 0.03, false), {0.1, 0.0, 0.2});
  EXPECT_EQ(pose_of(hold({0.11, 0.01, 0.1}, 0.03, false)).vector(), Pose2(0.1, 0.0, 0.2).vector());
  EXPECT_EQ(pose_of(hold({7.0, 0.0, 0.2}, 0.03, false)).vector(), Pose2(0.1, 0.0, 0.2).vector()) << "reset";
  expect_pose(hold({8.0, 0.0, 0.2}, 0.8, false), {1.1, 0.0, 0.2});
  const Reading put_down = hold({8.5, 0.0, 0.2}, 0.03, false);
  expect_pose(put_down, {1.6, 0.0, 0.2});
  EXPECT_FALSE(put_down.odometry_restarted);
  expect_pose(hold({8.5, 0.0, 0.0}, 0.03, false), {1.6, 0.0, 0.2});
  expect_pose(hold({8.5 + 1.0, 0.0, 0.0}, 0.3, true), {1.6 + std::cos(0.2), std::sin(0.2), 0.2});
}

TEST(LandedOdometryFreeze, TheNextTakeOffContinuesFromWhereItStood) {
  LandedOdometryFreeze ground;
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, kPi / 2.0}, true)));
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, kPi / 2.0}, false)));
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, 0.0}, false)));
  // By its estimate it flies along x; its nose points along y all the time.
  const Reading flown = ground.hold(reading_of({3.7, 1.0, 0.0}, true));
  expect_pose(flown, {3.0, 1.7, kPi / 2.0});
  EXPECT_EQ(flown.distance_m[0], 1.F);
  EXPECT_FALSE(flown.odometry_restarted);
}

TEST(LandedOdometryFreeze, CarriedElsewhereItRestarts) {
  Readings readings;
  static_cast<void>(readings.hold({3.0, 1.0, 1.0}, true));
  static_cast<void>(readings.hold({3.0, 1.0, 1.0}, false));
  EXPECT_FALSE(readings.hold({3.3, 1.0, 0.9}, false).odometry_restarted);
  const Reading carried = readings.hold({3.6, 1.0, 0.8}, false);
  EXPECT_TRUE(carried.odometry_restarted);
  EXPECT_EQ(carried.distance_m[0], 1.F);
  EXPECT_FALSE(readings.hold({3.7, 1.0, 0.8}, false).odometry_restarted);
}

/// As scripts do before they take off.
TEST(LandedOdometryFreeze, AnEstimatorThatIsResetOnTheGroundDoesNotCarryTheVehicle) {
  Readings readings;
  static_cast<void>(readings.hold({3.0, 1.0, kPi / 2.0}, true));
  static_cast<void>(readings.hold({3.0, 1.0, kPi / 2.0}, false));
  for (const double x_m : {0.0, 0.2, 0.3}) {  // and drifts
    const Reading reset = readings.hold({x_m, 0.0, 0.0}, false);
    expect_pose(reset, {3.0, 1.0, kPi / 2.0});
    EXPECT_FALSE(reset.odometry_restarted);
    EXPECT_TRUE(std::isnan(reset.distance_m[0]));
  }
  const Reading flown = readings.hold({0.5, 0.0, 0.0}, true);
  expect_pose(flown, {3.0, 1.2, kPi / 2.0});
  EXPECT_FALSE(flown.odometry_restarted);
}

TEST(LandedOdometryFreeze, IgnoresAVehicleThatHasNotFlownOrDoesNotReportIt) {
  LandedOdometryFreeze ground;
  expect_pose(ground.hold(reading_of({2.0, 0.0, 0.5}, false)), {2.0, 0.0, 0.5});
  EXPECT_EQ(ground.hold(reading_of({2.0, 0.0, 0.5}, false)).distance_m[0], 1.F);
  expect_pose(ground.hold(reading_of({2.0, 0.0, 0.1}, std::nullopt)), {2.0, 0.0, 0.1});
}

/// A reading each 100 ms of a vehicle whose height alone tells whether it flies.
class ByHeight : public testing::Test {
 protected:
  Reading hold(double height_m, const Pose2& T_vehicle_body) {
    Reading reading = reading_of(T_vehicle_body, std::nullopt);
    reading.at = device_ms(ms_ += 100);
    reading.height_m = height_m;
    return ground_.hold(reading);
  }

 private:
  LandedOdometryFreeze ground_;
  std::int64_t ms_ = 0;
};

TEST_F(ByHeight, WhatStaysLowForTwoSecondsHasLanded) {
  expect_pose(hold(0.0, {1.0, 0.0, 0.5}), {1.0, 0.0, 0.5});
  expect_pose(hold(0.5, {2.0, 0.0, 0.6}), {2.0, 0.0, 0.6});
  for (int i = 0; i < 20; ++i) expect_pose(hold(0.02, {2.1, 0.0, 0.6}), {2.1, 0.0, 0.6});
  for (const double yaw_rad : {0.6, 0.4, 0.1}) {  // it is pulled back
    const Reading held = hold(0.02, {2.1, 0.0, yaw_rad});
    expect_pose(held, {2.1, 0.0, 0.6});
    EXPECT_TRUE(std::isnan(held.distance_m[0]));
  }
  expect_pose(hold(0.5, {2.1 + std::cos(0.1), std::sin(0.1), 0.1}),
              {2.1 + std::cos(0.6), std::sin(0.6), 0.6});
}

TEST_F(ByHeight, ABoxThatItCrossesIsNoLanding) {
  for (int crossing = 0; crossing < 5; ++crossing) {
    expect_pose(hold(0.5, {0.0, 0.0, 0.0}), {0.0, 0.0, 0.0});
    for (int i = 1; i <= 6; ++i) {  // at 60 degrees and .4 m a second
      const Pose2 T_vehicle_body(0.04 * i, 0.0, radians(6.0 * i));
      const Reading held = hold(0.08, T_vehicle_body);
      expect_pose(held, T_vehicle_body);
      EXPECT_EQ(held.distance_m[0], 1.F);
    }
  }
}

TEST(LandedOdometryFreeze, WhatTheVehicleReportsOutvotesItsHeight) {
  LandedOdometryFreeze ground;
  Reading reading = reading_of({2.0, 0.0, 0.6}, true);
  reading.height_m = 0.5;
  static_cast<void>(ground.hold(reading));
  reading.height_m = 0.02;  // over a box
  reading.position_odom->x_m = 2.1;
  expect_pose(ground.hold(reading), {2.1, 0.0, 0.6});
  reading.is_flying.reset();  // of a block without it
  reading.position_odom->x_m = 2.2;
  expect_pose(ground.hold(reading), {2.2, 0.0, 0.6});
}

/// As log blocks without room for both have it.
TEST(LandedOdometryFreeze, FreezesPositionAndYawOfDifferentReadings) {
  LandedOdometryFreeze ground;
  const auto position = [&ground](double x_m, bool is_flying) {
    Reading reading;
    reading.position_odom = Point2{x_m, 0.0};
    reading.is_flying = is_flying;
    return ground.hold(reading);
  };
  const auto yaw = [&ground](double yaw_rad) {
    Reading reading = reading_of({0.0, 0.0, yaw_rad}, std::nullopt);
    reading.position_odom.reset();
    return ground.hold(reading);
  };
  static_cast<void>(position(1.0, true));
  static_cast<void>(yaw(0.5));
  EXPECT_DOUBLE_EQ(position(2.0, true).position_odom->x_m, 2.0);
  static_cast<void>(position(2.0, false));
  const Reading held = yaw(0.1);
  EXPECT_NEAR(*held.yaw_odom_rad, 0.5, 1e-12);
  EXPECT_FALSE(held.position_odom.has_value());
  EXPECT_TRUE(std::isnan(held.distance_m[0]));
  EXPECT_NEAR(position(2.0, false).position_odom->x_m, 2.0, 1e-12);
  // It takes off again and flies along its nose; the estimate is turned by -0.4 by now.
  const Point2 flown = *position(2.0 + std::cos(0.1), true).position_odom;
  EXPECT_NEAR(flown.x_m, 2.0 + std::cos(0.1) * std::cos(0.4), 1e-9);
}

TEST(LandedOdometryFreeze, DamagedNumbersAtTheLandingDoNotOutliveTheirPacket) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LandedOdometryFreeze ground;
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, 2.0}, true)));
  Reading damaged = reading_of({3.0, 1.0, 2.0}, false);
  damaged.position_odom = Point2{kNaN, 1.0};
  damaged.yaw_odom_rad = kInfinity;
  const Reading held = ground.hold(damaged);
  EXPECT_FALSE(std::isfinite(held.position_odom->x_m));  // for the assembler to leave out
  EXPECT_FALSE(std::isfinite(*held.yaw_odom_rad));
  expect_pose(ground.hold(reading_of({3.0, 1.0, 1.5}, false)), {3.0, 1.0, 2.0});
  expect_pose(ground.hold(reading_of({3.0, 1.0, 1.5}, true)), {3.0, 1.0, 2.0});
}

TEST(LandedOdometryFreeze, ARebootDiscardsTheLanding) {
  LandedOdometryFreeze ground;
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, 2.0}, true)));
  static_cast<void>(ground.hold(reading_of({3.0, 1.0, 1.0}, false)));
  Reading rebooted = reading_of({0.0, 0.0, 0.0}, false);
  rebooted.boot = 1;
  const Reading held = ground.hold(rebooted);
  expect_pose(held, {0.0, 0.0, 0.0});
  EXPECT_EQ(held.distance_m[0], 1.F);
}

}  // namespace
}  // namespace swiftlet
