// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/other_yaw_noise.hpp"

#include <gtest/gtest.h>

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

TEST(OtherYawNoise, StretchedStepsAreSoManyTimesAsLongAndTurnAsFar) {
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
