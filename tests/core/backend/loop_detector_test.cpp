// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_detector.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/closure_error.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kSubmapKeyframes = 12;
constexpr double kChiSquare99 = 11.34;  // of three degrees of freedom

/// A lap with exact dead reckoning and the beginning of a second: as the backend holds it when it looks for
/// loops.
class LoopDetectorTest : public testing::Test {
 protected:
  static TestVehicle lap_and_a_side() {
    TestVehicle vehicle = vehicle_at_start({}, 7);
    fly_along(vehicle, loop_corridor(), "bcdab");
    return vehicle;
  }

  explicit LoopDetectorTest(const TestVehicle& vehicle = lap_and_a_side()) : run(vehicle.samples()) {
    for (std::uint32_t first = 0; first + kSubmapKeyframes <= index_of(run.newest());
         first += kSubmapKeyframes / 2) {
      const auto id = static_cast<SubmapId>(submaps.size());
      submaps.push_back(std::make_shared<const Submap>(
          build_submap(id, static_cast<KeyframeId>(first), static_cast<KeyframeId>(first + kSubmapKeyframes),
                       run.scans(), run.chain(), run.T_local_keyframe(), config)));
    }
    graph.T_map_keyframe = run.T_local_keyframe();
    const Eigen::Matrix3d step_covariance = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();
    for (std::uint32_t to = 1; to <= index_of(run.newest()); ++to) {
      const Pose2 T_from_to = between(graph.T_map_keyframe[to - 1], graph.T_map_keyframe[to]);
      graph.constraints.push_back({static_cast<KeyframeId>(to - 1), static_cast<KeyframeId>(to), T_from_to,
                                   residual_information(T_from_to, step_covariance)});
    }
  }

  std::vector<LoopClosure> find(KeyframeId query) {
    tried = 0;
    return LoopDetector(config, run.scans(), run.chain())
        .find(query, submaps, graph, run.T_local_keyframe(), tried);
  }
  [[nodiscard]] Pose2 true_T_from_to(const LoopClosure& c) const {
    return between(run.T_local_keyframe()[index_of(c.from)], run.T_local_keyframe()[index_of(c.to)]);
  }

  BackendConfig config;
  StoredRun run;
  std::vector<std::shared_ptr<const Submap>> submaps;
  PoseGraph graph;
  std::uint64_t tried = 0;
};

TEST_F(LoopDetectorTest, FindsThePlacesOfTheFirstLapInTheSecond) {
  const std::vector<LoopClosure> closures = find(run.newest());
  ASSERT_FALSE(closures.empty());
  EXPECT_GE(tried, closures.size());
  for (const LoopClosure& c : closures) {
    EXPECT_EQ(c.to, run.newest());
    EXPECT_GE(c.score, config.min_score);
    EXPECT_FALSE(c.dropped);
    EXPECT_LT(chi_square_against(c, true_T_from_to(c)), kChiSquare99);
  }
}

TEST_F(LoopDetectorTest, FindsThemFromAPredictionThatHasDrifted) {
  // From the second lap on the map is off, as before a loop is closed.
  const Pose2 T_drift(0.4, -0.3, 0.04);
  for (std::size_t k = index_of(run.newest()) - 25; k < graph.T_map_keyframe.size(); ++k)
    graph.T_map_keyframe[k] = T_drift * graph.T_map_keyframe[k];
  const std::vector<LoopClosure> closures = find(run.newest());
  ASSERT_FALSE(closures.empty());
  for (const LoopClosure& c : closures) EXPECT_LT(chi_square_against(c, true_T_from_to(c)), kChiSquare99);
}

TEST_F(LoopDetectorTest, SearchesNothingWhereNothingWasFlownBefore) {
  // Halfway around the first lap.
  EXPECT_TRUE(find(static_cast<KeyframeId>(45)).empty());
  EXPECT_EQ(tried, 0U);
}

TEST_F(LoopDetectorTest, LeavesRecentSubmapsAlone) {
  for (std::uint32_t query = 0; query <= index_of(run.newest()); query += 5) {
    for (const LoopClosure& c : find(static_cast<KeyframeId>(query)))
      EXPECT_GT(run.chain().path_m(c.to) - run.chain().path_m(c.from), config.min_travel_between_m);
  }
  config.min_travel_between_m = 1000.0;
  EXPECT_TRUE(find(run.newest()).empty());
  EXPECT_EQ(tried, 0U);
}

TEST_F(LoopDetectorTest, FewerPointsThanConfiguredDecideNothing) {
  config.min_match_points = 100000;
  EXPECT_TRUE(find(run.newest()).empty());
  EXPECT_EQ(tried, 0U);
}

TEST_F(LoopDetectorTest, SearchesNoMoreSubmapsThanConfigured) {
  find(run.newest());
  ASSERT_GT(tried, 1U);
  config.max_candidates = 1;
  EXPECT_LE(find(run.newest()).size(), 1U);
  EXPECT_EQ(tried, 1U);
}

TEST_F(LoopDetectorTest, KeepsNoMatchBelowTheLeastScore) {
  config.min_score = 0.95;  // of the points; of the overlap as well, which is full here
  for (const LoopClosure& c : find(run.newest())) EXPECT_GE(c.score, 0.95);
  config.min_score = 0.999;
  EXPECT_TRUE(find(run.newest()).empty());
}

/// After a lap someone carries the vehicle on; it has hardly flown since.
class LoopDetectorAfterCarryingTest : public LoopDetectorTest {
 protected:
  static TestVehicle carried() {
    TestVehicle vehicle = lap_and_a_side();
    const Point2 near_b = loop_corridor().place('b');
    vehicle.carry_to(loop_corridor(), Pose2(near_b.x_m, near_b.y_m, kPi / 2.0));
    vehicle.fly_to(loop_corridor(), {near_b.x_m, near_b.y_m + 0.55});
    return vehicle;
  }
  LoopDetectorAfterCarryingTest() : LoopDetectorTest(carried()) {}
};

TEST_F(LoopDetectorAfterCarryingTest, WhatWasSeenBeforeIsNotMatchedAsIfItWereConnected) {
  // The few decimetres since give too few points; all of the multiscan's length would give plenty.
  config.min_match_points = 60;
  find(run.newest());
  EXPECT_EQ(tried, 0U);
}

}  // namespace
}  // namespace swiftlet
