// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/odometry_timeline.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ContinuityLimits limits() {
  ContinuityLimits limits;
  limits.longest_interpolation = milliseconds(150);
  limits.longest_silence = seconds(1);
  return limits;
}
using Positions = OdometryTimeline<Point2>;
using Yaws = OdometryTimeline<YawReading>;

TEST(OdometryTimeline, InterpolatesBetweenNeighbours) {
  Positions positions(limits());
  positions.add(device_ms(0), {0.0, 1.0});
  positions.add(device_ms(100), {0.2, 1.1});
  const auto answer = positions.at(device_ms(25));
  ASSERT_EQ(answer.outcome, Positions::Outcome::kFound);
  EXPECT_NEAR(answer.value.x_m, 0.05, 1e-12);
  EXPECT_NEAR(answer.value.y_m, 1.025, 1e-12);
  EXPECT_EQ(positions.at(device_ms(100)).value.x_m, 0.2);
}

TEST(OdometryTimeline, InterpolatesYawTheShorterWay) {
  Yaws yaws(limits());
  yaws.add(device_ms(0), {3.1});
  yaws.add(device_ms(100), {-3.1});
  const auto answer = yaws.at(device_ms(50));
  ASSERT_EQ(answer.outcome, Yaws::Outcome::kFound);
  EXPECT_NEAR(std::abs(answer.value.yaw_rad), kPi, 1e-12);
}

TEST(OdometryTimeline, AsksToWaitForReadingsStillToCome) {
  Positions positions(limits());
  EXPECT_EQ(positions.at(device_ms(0)).outcome, Positions::Outcome::kTooEarly);
  positions.add(device_ms(100), {});
  EXPECT_EQ(positions.at(device_ms(101)).outcome, Positions::Outcome::kTooEarly);
  EXPECT_EQ(positions.at(device_ms(99)).outcome, Positions::Outcome::kNever);
}

TEST(OdometryTimeline, NeverInterpolatesAcrossAHoleButContinuesBehindIt) {
  Positions positions(limits());
  positions.add(device_ms(0), {0.0, 0.0});
  positions.add(device_ms(200), {0.1, 0.0});
  EXPECT_EQ(positions.at(device_ms(100)).outcome, Positions::Outcome::kHole);
  EXPECT_EQ(positions.at(device_ms(0)).run, positions.at(device_ms(200)).run);
}

TEST(OdometryTimeline, ALongSilenceBeginsANewRun) {
  Positions positions(limits());
  positions.add(device_ms(0), {});
  positions.add(device_ms(1001), {});
  EXPECT_NE(positions.at(device_ms(0)).run, positions.at(device_ms(1001)).run);
}

TEST(OdometryTimeline, CountsThePausesBeforeAReadingAndGoesOnBehindThem) {
  ContinuityLimits watched = limits();
  watched.longest_silence = seconds(30);
  watched.unwatched_after = seconds(1);
  Positions positions(watched);
  for (const int ms : {0, 999, 1999}) positions.add(device_ms(ms), {});
  EXPECT_EQ(positions.at(device_ms(999)).pauses, 0U);
  EXPECT_EQ(positions.at(device_ms(1999)).pauses, 1U);
  EXPECT_EQ(positions.at(device_ms(1999)).run, positions.at(device_ms(0)).run);
}

TEST(OdometryTimeline, AnImpossibleJumpBeginsANewRun) {
  Positions positions(limits());
  positions.add(device_ms(0), {0.0, 0.0});
  positions.add(device_ms(100), {0.55, 0.0});  // 5.5 m/s, within speed and slack
  positions.add(device_ms(200), {1.25, 0.0});
  EXPECT_EQ(positions.at(device_ms(50)).run, positions.at(device_ms(100)).run);
  EXPECT_EQ(positions.at(device_ms(150)).outcome, Positions::Outcome::kNever);
  EXPECT_NE(positions.at(device_ms(200)).run, positions.at(device_ms(100)).run);
  Yaws yaws(limits());
  yaws.add(device_ms(0), {0.0});
  yaws.add(device_ms(100), {1.5});
  EXPECT_EQ(yaws.at(device_ms(50)).outcome, Yaws::Outcome::kNever);
}

TEST(OdometryTimeline, GoesOnWhileReadingsComeOftenEnough) {
  Positions positions(limits());
  positions.add(device_ms(0), {});
  EXPECT_FALSE(positions.goes_on(device_ms(0))) << "one says nothing about the next";
  positions.add(device_ms(100), {});
  EXPECT_TRUE(positions.goes_on(device_ms(250)));
  EXPECT_FALSE(positions.goes_on(device_ms(251)));
  positions.add(device_ms(1100), {});
  EXPECT_FALSE(positions.goes_on(device_ms(1100)));
}

TEST(OdometryTimeline, KeepsTheLatestWhenFull) {
  OdometryTimeline<Point2, 3> positions(limits());
  for (int i = 0; i < 10; ++i) positions.add(device_ms(100L * i), {0.1 * i, 0.0});
  EXPECT_EQ(positions.at(device_ms(650)).outcome, (OdometryTimeline<Point2, 3>::Outcome::kNever));
  EXPECT_NEAR(positions.at(device_ms(750)).value.x_m, 0.75, 1e-12);
  EXPECT_NEAR(positions.at(device_ms(900)).value.x_m, 0.9, 1e-12);
}

TEST(OdometryTimeline, IgnoresAReadingThatIsNotLater) {
  Positions positions(limits());
  positions.add(device_ms(100), {1.0, 0.0});
  positions.add(device_ms(100), {2.0, 0.0});
  positions.add(device_ms(50), {3.0, 0.0});
  EXPECT_EQ(positions.at(device_ms(100)).value.x_m, 1.0);
  EXPECT_EQ(positions.at(device_ms(50)).outcome, Positions::Outcome::kNever);
}

}  // namespace
}  // namespace swiftlet
