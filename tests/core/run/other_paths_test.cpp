// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/other_paths.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/frontend/frontend.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

MappingSettings settings() {
  MappingSettings settings;
  settings.sensor = SensorModel::crazyflie();
  settings.backend.refine_online = false;
  return settings;
}
const MappingSettings kSettings = settings();

std::vector<RangeSample> two_laps() {
  TestVehicleModel drifting;
  drifting.drift_rad_per_m = 0.01;
  TestVehicle vehicle = vehicle_at_start(drifting, 81);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  return vehicle.samples();
}

TEST(OtherYawNoise, TheSameNoiseGivesTheSamePathFromTheScansThatWereKept) {
  Frontend frontend(kSettings.frontend, kSettings.sensor, BeamLayout::multiranger());
  Backend backend(kSettings.backend, kSettings.sensor, BeamLayout::multiranger());
  for (const RangeSample& sample : two_laps()) static_cast<void>(backend.add(frontend.process(sample)));
  const std::optional<OtherPath> same =
      path_with_yaw_noise(1.0, backend.scans().samples(), kSettings, BeamLayout::multiranger());
  static_cast<void>(backend.finish());
  std::vector<Pose2> T_map_body;
  for (const auto& [id, scan] : backend.scans().all()) T_map_body.push_back(backend.T_map_body(id));
  ASSERT_TRUE(same);
  EXPECT_TRUE(same_bits(same->T_map_body, T_map_body));
}

TEST(OtherYawNoise, AnotherNoiseGivesAnotherPath) {
  const std::vector<RangeSample> samples = two_laps();
  const auto path = [&](double factor) {
    return path_with_yaw_noise(factor, samples, kSettings, BeamLayout::multiranger());
  };
  const std::optional<OtherPath> half = path(0.5);
  const std::optional<OtherPath> twice = path(2.0);
  ASSERT_TRUE(half);
  ASSERT_TRUE(twice);
  EXPECT_EQ(half->yaw_noise_factor, 0.5);
  EXPECT_EQ(half->T_map_body.size(), samples.size());
  EXPECT_FALSE(same_bits(half->T_map_body, twice->T_map_body));
}

TEST(OtherYawNoise, ThereIsNoneWhereDeadReckoningIsTheMap) {
  std::vector<RangeSample> blind = two_laps();
  for (RangeSample& sample : blind) sample.status.fill(RangeStatus::kNoReturn);
  EXPECT_FALSE(path_with_yaw_noise(0.5, blind, kSettings, BeamLayout::multiranger()));
}

/// Six samples, 0.11 to 0.19 s apart, with breaks of motion before the first, the third and the fifth.
std::vector<RangeSample> with_breaks() {
  std::vector<RangeSample> samples(6);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Duration after = std::chrono::milliseconds(100 * i + 10 * i * i);
    samples[i].sequence = static_cast<std::uint32_t>(i);
    samples[i].measured_at = DeviceTime(std::chrono::seconds(7) + after);
    samples[i].stamp = HostTime(std::chrono::seconds(1'700'000'000) + after);
    samples[i].T_odom_body = Pose2(0.1 * static_cast<double>(i), 0.0, 0.2);
    samples[i].starts_segment = i % 2 == 0;
    samples[i].odometry_ran_on = i == 4;
  }
  return samples;
}

TEST(PlayedBackwards, LeavesBreaksOfMotionBetweenTheSameSamples) {
  const std::vector<RangeSample> played = played_backwards(with_breaks());
  std::vector<bool> starts, ran_on;
  for (const RangeSample& sample : played) {
    starts.push_back(sample.starts_segment);
    ran_on.push_back(sample.odometry_ran_on);
  }
  EXPECT_EQ(starts, std::vector<bool>({true, false, true, false, true, false}));
  EXPECT_EQ(ran_on, std::vector<bool>({false, false, true, false, false, false}));
}

TEST(PlayedBackwards, KeepsTheTimesBetweenSamples) {
  const std::vector<RangeSample> samples = with_breaks();
  const std::vector<RangeSample> played = played_backwards(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t other = samples.size() - 1 - i;
    EXPECT_EQ(played[i].sequence, i);
    EXPECT_EQ(played[i].measured_at - played[0].measured_at,
              samples.back().measured_at - samples[other].measured_at);
    EXPECT_EQ(played[i].stamp - played[0].stamp, samples.back().stamp - samples[other].stamp);
    EXPECT_TRUE(same_bits(std::vector{played[i].T_odom_body}, std::vector{samples[other].T_odom_body}));
  }
  EXPECT_EQ(played[0].stamp, samples[0].stamp);
}

TEST(PlayedBackwards, TwiceIsTheRunItself) {
  const std::vector<RangeSample> samples = with_breaks();
  const std::vector<RangeSample> twice = played_backwards(played_backwards(samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(twice[i].measured_at, samples[i].measured_at);
    EXPECT_EQ(twice[i].starts_segment, samples[i].starts_segment) << i;
    EXPECT_EQ(twice[i].odometry_ran_on, samples[i].odometry_ran_on) << i;
  }
  EXPECT_TRUE(played_backwards({}).empty());
}

TEST(PlayedBackwards, ACalibrationCorrectsEachStepToTheInverseOfTheTrueOne) {
  OdometryCalibration calibration;
  calibration.forward_scale = calibration.sideways_scale = 1.02;
  calibration.yaw_per_metre_rad = 0.01;
  calibration.yaw_per_radian = 0.03;
  calibration.yaw_per_second_rad = 0.002;
  for (const Pose2& step : {Pose2(0.05, 0.0, 0.0), Pose2(0.0, 0.0, 0.1), Pose2(-0.05, 0.0, 0.0)}) {
    const Duration elapsed = std::chrono::milliseconds(100);
    EXPECT_TRUE(poses_near(calibration_backwards(calibration).corrected(step.inverse(), elapsed),
                           calibration.corrected(step, elapsed).inverse(), 1e-3, 1e-9));
  }
}

/// As a gyro reports them whose heading is short by so much each second.
std::vector<RangeSample> with_missed_yaw(std::vector<RangeSample> samples, double missed_rad_per_s) {
  Pose2 T_odom_before = samples.front().T_odom_body;  // true
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Pose2 T_odom_body = samples[i].T_odom_body;
    const Pose2 step = between(T_odom_before, T_odom_body);
    const double missed_rad =
        missed_rad_per_s * to_seconds(samples[i].measured_at - samples[i - 1].measured_at);
    samples[i].T_odom_body =
        samples[i - 1].T_odom_body * Pose2(step.x_m(), step.y_m(), step.yaw_rad() - missed_rad);
    T_odom_before = T_odom_body;
  }
  return samples;
}

TEST(PathBackwards, IsCorrectedByTheCalibration) {
  TestVehicle vehicle = vehicle_at_start({}, 81);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  MappingSettings calibrated = kSettings;
  calibrated.sensor.odometry_calibration.yaw_per_second_rad = 0.01;
  const std::optional<OtherPath> backwards =
      path_backwards(with_missed_yaw(vehicle.samples(), 0.01), calibrated, BeamLayout::multiranger());
  ASSERT_TRUE(backwards);
  const std::vector<Pose2> truth = true_poses(vehicle);
  for (const std::size_t i : {truth.size() / 3, truth.size() - 1})
    EXPECT_TRUE(poses_near(between(backwards->T_map_body.front(), backwards->T_map_body[i]),
                           between(truth.front(), truth[i]), 0.1, 0.05))
        << i;
}

TEST(PathBackwards, IsAnotherThatFindsTheSameBuildingInTheOrderOfTheSamples) {
  const std::vector<RangeSample> samples = two_laps();
  const std::optional<OtherPath> forwards =
      path_with_yaw_noise(1.0, samples, kSettings, BeamLayout::multiranger());
  const std::optional<OtherPath> backwards = path_backwards(samples, kSettings, BeamLayout::multiranger());
  ASSERT_TRUE(forwards);
  ASSERT_TRUE(backwards);
  EXPECT_EQ(backwards->source, MapSource::kBackwards);
  ASSERT_EQ(backwards->T_map_body.size(), samples.size());
  EXPECT_FALSE(same_bits(forwards->T_map_body, backwards->T_map_body));
  const auto moved = [&](const OtherPath& path, std::size_t i) {
    return between(path.T_map_body.front(), path.T_map_body[i]);
  };
  for (const std::size_t i : {samples.size() / 3, samples.size() - 1})
    EXPECT_TRUE(poses_near(moved(*forwards, i), moved(*backwards, i), 0.1, 0.05)) << i;
}

TEST(StretchSteps, MakesThemSoManyTimesAsLongAndTheyTurnAsFar) {
  const std::vector<RangeSample> reported = two_laps();
  std::vector<RangeSample> samples = reported;
  std::vector<double> scale(samples.size(), 1.0);
  for (std::size_t i = 100; i < 200; ++i) scale[i] = 1.5;
  stretch_steps(samples, scale);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Pose2 step = between(reported[i - 1].T_odom_body, reported[i].T_odom_body);
    ASSERT_TRUE(poses_near(between(samples[i - 1].T_odom_body, samples[i].T_odom_body),
                           stretched(step, scale[i]), 1e-9, 1e-9))
        << i;
  }
}

}  // namespace
}  // namespace swiftlet
