// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/joint_problem.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>

#include "tests/core/calibration/room_flight.hpp"

namespace swiftlet {
namespace {

constexpr double kSigmas = 3.0;
bool go_on(double) { return true; }

JointEstimate estimate_of(const RoomFlight& flight, const SensorModel& sensor) {
  FlownScans flown = fly(flight);
  const Result<JointEstimate> estimate = estimate_jointly(flown.scans, sensor, flown.T_map_body, go_on);
  EXPECT_TRUE(estimate);
  return *estimate;
}

void expect_error(const JointEstimate& estimate, SystematicError error, double truth, double largest_sigma) {
  const double sigma = estimate.sigma(index_of(error));
  EXPECT_NEAR(estimate.errors(index_of(error)), truth, kSigmas * sigma);
  EXPECT_LT(sigma, largest_sigma);
}

TEST(JointProblem, FindsNothingWhereNothingIsWrong) {
  const JointEstimate estimate = estimate_of({}, SensorModel::crazyflie());
  expect_error(estimate, SystematicError::kRangeAge, 0.0, 0.01);
  expect_error(estimate, SystematicError::kForwardScale, 0.0, 0.02);
  expect_error(estimate, SystematicError::kYawPerRadian, 0.0, 0.01);
  expect_error(estimate, SystematicError::kYawPerSecond, 0.0, radians(0.1));
  EXPECT_GT(estimate.patches, 10U);
  EXPECT_GT(estimate.returns_on_them, 2000U);
}

TEST(JointProblem, FindsHowOldTheRangesAre) {
  for (const double age_s : {-0.04, 0.06}) {
    RoomFlight flight;
    flight.age_s = age_s;
    expect_error(estimate_of(flight, SensorModel::crazyflie()), SystematicError::kRangeAge, age_s, 0.01);
  }
}

TEST(JointProblem, FindsTheScaleOfOdometryAndTheDriftOfAGyro) {
  RoomFlight flight;
  flight.calibration.forward_scale = 1.08;
  flight.calibration.yaw_per_radian = 0.03;
  flight.calibration.yaw_per_second_rad = radians(0.5);
  const JointEstimate estimate = estimate_of(flight, SensorModel::crazyflie());
  expect_error(estimate, SystematicError::kForwardScale, 0.08, 0.02);
  expect_error(estimate, SystematicError::kYawPerRadian, 0.03, 0.01);
  expect_error(estimate, SystematicError::kYawPerSecond, radians(0.5), radians(0.1));
  EXPECT_NEAR(estimate.errors(index_of(SystematicError::kYawPerMetre)), 0.0, 1e-9);
}

TEST(JointProblem, FindsTheDriftOfWheels) {
  RoomFlight flight;
  flight.calibration.yaw_per_metre_rad = radians(3.0);
  const JointEstimate estimate = estimate_of(flight, SensorModel::carmen_laser());
  expect_error(estimate, SystematicError::kYawPerMetre, radians(3.0), radians(1.0));
  EXPECT_NEAR(estimate.errors(index_of(SystematicError::kYawPerSecond)), 0.0, 1e-9);
}

TEST(JointProblem, KnowsLittleWithoutWalls) {
  FlownScans flown = fly({});
  for (CalibrationScan& scan : flown.scans) scan.hits_body.clear();
  const Result<JointEstimate> estimate =
      estimate_jointly(flown.scans, SensorModel::crazyflie(), flown.T_map_body, go_on);
  ASSERT_TRUE(estimate) << estimate.error().message;
  EXPECT_EQ(estimate->returns_on_them, 0U);
  EXPECT_GT(estimate->sigma(index_of(SystematicError::kForwardScale)), 0.1);
}

TEST(JointProblem, FindsNoAgeWhereStampsComeInBunches) {
  RoomFlight flight;
  flight.age_s = 0.06;
  FlownScans flown = fly(flight);
  for (std::size_t i = 0; i < flown.scans.size(); ++i) {
    const std::size_t bunch = i / 3;
    flown.scans[i].measured_at =
        DeviceTime(from_seconds(0.3 * static_cast<double>(bunch) + 0.001 * static_cast<double>(i % 3)));
  }
  const Result<JointEstimate> estimate =
      estimate_jointly(flown.scans, SensorModel::crazyflie(), flown.T_map_body, go_on);
  ASSERT_TRUE(estimate) << estimate.error().message;
  EXPECT_NEAR(estimate->errors(index_of(SystematicError::kRangeAge)), 0.0, 1e-6);
  EXPECT_GT(estimate->sigma(index_of(SystematicError::kRangeAge)), 0.1);
}

TEST(JointProblem, IsNotMisledByAClockThatBeginsAnew) {
  for (const int restarts_at_s : {-30, 1'000'000'000}) {
    FlownScans flown = fly({});
    const Result<JointEstimate> before =
        estimate_jointly(flown.scans, SensorModel::crazyflie(), flown.T_map_body, go_on);
    const std::size_t half = flown.scans.size() / 2;
    const Duration lost = DeviceTime(std::chrono::seconds(restarts_at_s)) - flown.scans[half].measured_at;
    flown.scans[half].starts_segment = true;
    for (std::size_t i = half; i < flown.scans.size(); ++i) flown.scans[i].measured_at += lost;
    const Result<JointEstimate> estimate =
        estimate_jointly(flown.scans, SensorModel::crazyflie(), flown.T_map_body, go_on);
    ASSERT_TRUE(before && estimate);
    EXPECT_TRUE((estimate->sigma.array() <= 1.5 * before->sigma.array()).all());
    EXPECT_TRUE((estimate->sigma.array() >= 0.5 * before->sigma.array()).all());
    const SystematicErrors moved = (estimate->errors - before->errors).cwiseAbs();
    EXPECT_TRUE((moved.array() <= before->sigma.array()).all());
  }
}

TEST(JointProblem, GivesTheSameTwice) {
  RoomFlight flight;
  flight.scans = 300;
  const JointEstimate first = estimate_of(flight, SensorModel::crazyflie());
  const JointEstimate second = estimate_of(flight, SensorModel::crazyflie());
  EXPECT_EQ(first.errors, second.errors);
  EXPECT_EQ(first.sigma, second.sigma);
}

TEST(JointProblem, StopsWhenToldTo) {
  RoomFlight flight;
  flight.scans = 100;
  FlownScans flown = fly(flight);
  const Result<JointEstimate> stopped =
      estimate_jointly(flown.scans, SensorModel::crazyflie(), flown.T_map_body, [](double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kTimeout);
}

}  // namespace
}  // namespace swiftlet
