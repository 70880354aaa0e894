// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/live_observer.hpp"

#include <gmock/gmock.h>

#include <chrono>

#include "tests/support/dead_reckoning_frontend.hpp"

namespace swiftlet {
namespace {

/// Out along a wall to 15 m and back, the left or right beam on it; on the way back poses are published
/// 0.4 m off, away from the wall.
class WatchedFlight {
 public:
  WatchedFlight() {
    for (int i = 0; i <= 300; ++i) {
      add(i);
      observer_.look();
    }
  }
  [[nodiscard]] StampedPath truth() const { return StampedPath(truth_); }
  [[nodiscard]] const LiveObserver& observer() const { return observer_; }
  [[nodiscard]] const Backend& backend() const { return backend_; }

 private:
  static BackendConfig without_loops() {
    BackendConfig config;
    config.close_loops = false;
    return config;
  }
  void add(int i) {
    const bool is_back = i > 150;
    const Pose2 T_world_body(0.1 * (is_back ? 300 - i : i), 0.0, is_back ? kPi : 0.0);
    RangeSample sample;
    sample.stamp = HostTime(std::chrono::milliseconds(1000 + 100 * i));
    sample.T_odom_body = T_world_body;
    sample.starts_segment = i == 0;
    sample.beam_count = 4;
    for (std::size_t beam = 0; beam < 4; ++beam) sample.status[beam] = RangeStatus::kInvalid;
    const std::size_t at_wall = is_back ? 3 : 1;
    sample.status[at_wall] = RangeStatus::kHit;
    sample.distance_m[at_wall] = 1.0F;
    FrontendStep step = frontend_.process(sample);
    step.T_map_body = is_back ? Pose2(0.0, -0.4, 0.0) * T_world_body : T_world_body;
    backend_.add(step);
    truth_.push_back({sample.stamp, T_world_body});
  }

  DeadReckoningFrontend frontend_;
  Backend backend_{without_loops(), SensorModel::crazyflie(), BeamLayout::multiranger()};
  LiveObserver observer_{backend_};
  std::vector<StampedPose> truth_;
};

TEST(LiveObserver, HoldsPosesAgainstTheMapThatWasPublishedBefore) {
  const WatchedFlight flight;
  const KnownPlaceError error = flight.observer().error(flight.truth());
  EXPECT_EQ(error.moments, 66U);
  EXPECT_NEAR(error.rms_m, 0.4, 1e-6);
  EXPECT_NEAR(error.across_p95_m.value(), 0.4, 1e-6);
  EXPECT_NEAR(error.along_p95_m.value(), 0.0, 1e-6);
  EXPECT_EQ(error.jumps, 1U);
}

TEST(LiveObserver, LeavesOutMomentsWithoutTruth) {
  const WatchedFlight flight;
  EXPECT_EQ(flight.observer().error(StampedPath({{HostTime(), Pose2()}})).moments, 0U);
}

TEST(LiveObserver, AFinishedRunIsJudgedByItsNewestPose) {
  const WatchedFlight flight;
  const KnownPlaceError error = newest_pose_error(flight.backend(), flight.truth());
  EXPECT_EQ(error.moments, 1U);
  EXPECT_NEAR(error.rms_m, 0.0, 1e-6) << "not as published, but as the backend has it";
}

}  // namespace
}  // namespace swiftlet
