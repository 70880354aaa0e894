// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_again.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/frontend/frontend.hpp"
#include "core/run/other_paths.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

struct FlownBackend {
  explicit FlownBackend(const BackendConfig& config)
      : settings{.backend = config, .sensor = SensorModel::crazyflie()},
        backend(config, settings.sensor, BeamLayout::multiranger()) {
    TestVehicle vehicle = vehicle_at_start({}, 82);
    fly_along(vehicle, loop_corridor(), "bcdab");
    Frontend frontend(settings.frontend, settings.sensor, BeamLayout::multiranger());
    for (const RangeSample& sample : vehicle.samples())
      static_cast<void>(backend.add(frontend.process(sample)));
  }

  MappingSettings settings;
  Backend backend;
};

TEST(MapAgain, GivesThePathsInTheirOrderAndTheSameOnesEachTime) {
  const FlownBackend flown({});
  const std::vector<OtherPath> once = map_again(flown.backend, flown.settings, {});
  const std::vector<OtherPath> again = map_again(flown.backend, flown.settings, {});
  ASSERT_EQ(once.size(), kOtherYawNoise.size() + 1);
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_TRUE(same_bits(once[i].T_map_body, again[i].T_map_body));
  for (std::size_t i = 0; i < kOtherYawNoise.size(); ++i) {
    EXPECT_EQ(once[i].source, MapSource::kOtherYawNoise);
    EXPECT_EQ(once[i].yaw_noise_factor, kOtherYawNoise[i]);
  }
  EXPECT_EQ(once.back().source, MapSource::kBackwards);
}

TEST(MapAgain, GivesOnePathWithStepsOfOtherLengths) {
  const FlownBackend flown({});
  const std::vector<double> as_reported(flown.backend.scans().size(), 1.0);
  const std::vector<double> longer(flown.backend.scans().size(), 1.1);
  const std::vector<OtherPath> one = map_again(flown.backend, flown.settings, as_reported);
  const std::vector<OtherPath> other = map_again(flown.backend, flown.settings, longer);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(one.front().source, MapSource::kFloorKnown);
  EXPECT_EQ(one.front().yaw_noise_factor, 1.0);
  EXPECT_FALSE(same_bits(one.front().T_map_body, other.front().T_map_body));
}

TEST(MapAgain, GivesNothingWhereItIsNotWanted) {
  for (bool BackendConfig::*const off :
       {&BackendConfig::map_again, &BackendConfig::refine, &BackendConfig::close_loops}) {
    BackendConfig config;
    config.*off = false;
    const FlownBackend flown(config);
    EXPECT_TRUE(map_again(flown.backend, flown.settings, {}).empty());
  }
}

}  // namespace
}  // namespace swiftlet
