// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/keyframe_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/backend/refinement/doubted_motion.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/odometry_covariance.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

constexpr double kStepM = 0.5;

KeyframeId keyframe_id(std::uint32_t number) { return make_id<KeyframeId>(number); }

/// A straight flight along x, one scan a keyframe.
class KeyframeGraphTest : public testing::Test {
 protected:
  void fly(std::uint32_t keyframes) {
    for (std::uint32_t i = 0; i < keyframes; ++i) add_keyframe();
  }
  /// Returns whether the graph moved.
  bool add_keyframe(bool has_restarted = false) {
    const KeyframeId made_id = T_local_keyframe_.end_id();
    FrontendStep step;
    step.keyframe = made_id;
    step.sample.T_odom_body = Pose2(kStepM * index_of(made_id), 0.0, 0.0);
    chain_.add(scans_.add(step));
    Keyframe made;
    made.id = made_id;
    made.starts_segment = has_restarted || made_id == keyframe_id(0);
    made.motion_covariance = Covariance3::from_matrix(Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal());
    EXPECT_TRUE(made.T_local_keyframe.try_push_back(step.sample.T_odom_body));
    T_local_keyframe_.push_back(step.sample.T_odom_body);
    graph_.add_keyframe(made, T_local_keyframe_);
    return graph_.settle();
  }
  /// The way from keyframe 0 is longer than the motion has it.
  [[nodiscard]] RelativePoseFactor<KeyframeId> closure_to(std::uint32_t to, double longer_m) const {
    return {keyframe_id(0), keyframe_id(to), Pose2(kStepM * to + longer_m, 0.0, 0.0),
            1e4 * Eigen::Matrix3d::Identity(), true};
  }

  BackendConfig config_;
  ScanStore scans_{BeamLayout::multiranger()};
  KeyframeChain chain_{scans_};
  KeyframePoses T_local_keyframe_;
  KeyframeGraph graph_{config_, chain_};
};

TEST_F(KeyframeGraphTest, FollowsTheMotionWhileNothingElseIsKnown) {
  fly(20);
  EXPECT_EQ(graph_.state(), GraphState::kSettled);
  EXPECT_EQ(graph_.counters().optimizations, 0U);
  EXPECT_TRUE(
      poses_near(graph_.T_map_keyframe()[keyframe_id(19)], Pose2(19 * kStepM, 0.0, 0.0), 1e-12, 1e-12));
}

TEST_F(KeyframeGraphTest, TakesTheCorrectionsOfTheLastStepsByTheFrontend) {
  fly(5);
  T_local_keyframe_[keyframe_id(3)] = Pose2(3 * kStepM, 0.1, 0.2);
  Keyframe made;
  made.id = T_local_keyframe_.push_back(Pose2(5 * kStepM, 0.0, 0.0));
  made.motion_covariance = Covariance3::from_matrix(Eigen::Matrix3d::Identity());
  for (const Pose2& T : T_local_keyframe_.values().last(3))
    EXPECT_TRUE(made.T_local_keyframe.try_push_back(T));
  graph_.add_keyframe(made, T_local_keyframe_);
  for (const auto& [id, T_local] : T_local_keyframe_)
    EXPECT_TRUE(poses_near(graph_.T_map_keyframe()[id], T_local, 1e-12, 1e-12)) << index_of(id);
}

TEST_F(KeyframeGraphTest, AVehicleThatRestartedMostLikelyStoodStillUntilClosuresContradict) {
  fly(10);
  add_keyframe(true);
  fly(9);
  const auto sigma_m = [&] {
    return std::sqrt(relative_covariances(graph_.graph(), keyframe_id(9),
                                          config_.tuning.covariance)[keyframe_id(10)](0, 0));
  };
  EXPECT_NEAR(sigma_m(), kStoodStill.xy_m, 0.01);
  const std::vector<RelativePoseFactor<KeyframeId>> elsewhere{closure_to(12, 6.0), closure_to(15, 6.0),
                                                              closure_to(18, 6.0)};
  ASSERT_TRUE(graph_.accommodate(elsewhere, keyframe_id(10)));
  for (const RelativePoseFactor<KeyframeId>& closure : elsewhere) graph_.add_closure(closure);
  graph_.optimize();
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(15)].x_m(), 15 * kStepM + 6.0, 0.05);
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(9)].x_m(), 9 * kStepM, 0.05);
}

class CarriedVehicleTest : public KeyframeGraphTest, public testing::WithParamInterface<double> {};

TEST_P(CarriedVehicleTest, FitsWhereItWasPutDownWithAnyHeading) {
  fly(10);
  add_keyframe(true);
  fly(9);
  const Pose2 T_map_put_down(3.0, 2.0, GetParam());
  const Pose2 T_restarted_map = graph_.T_map_keyframe()[keyframe_id(10)].inverse();
  std::vector<RelativePoseFactor<KeyframeId>> matches;
  double error_rad = 5e-4;  // of a match's heading: from half a turn away, residuals of both signs
  for (const std::uint32_t to : {12U, 14U, 16U, 18U}) {
    const Pose2 T_map_to = T_map_put_down * T_restarted_map * graph_.T_map_keyframe()[keyframe_id(to)];
    error_rad = -error_rad;
    const Pose2 T_from_to =
        between(graph_.T_map_keyframe()[keyframe_id(4)], T_map_to) * Pose2(0.0, 0.0, error_rad);
    matches.push_back({keyframe_id(4), keyframe_id(to), T_from_to, 1e6 * Eigen::Matrix3d::Identity(), true});
  }
  ASSERT_TRUE(graph_.accommodate(matches, keyframe_id(10)));
  EXPECT_TRUE(poses_near(graph_.T_map_keyframe()[keyframe_id(10)], T_map_put_down, 0.01, 0.01));
  EXPECT_TRUE(poses_near(graph_.T_map_keyframe()[keyframe_id(9)], Pose2(9 * kStepM, 0.0, 0.0), 0.01, 0.01));
}

INSTANTIATE_TEST_SUITE_P(Headings, CarriedVehicleTest,
                         testing::Values(0.0, 0.5 * kPi, kPi - 0.1, kPi, 0.1 - kPi, -0.5 * kPi));

TEST_F(KeyframeGraphTest, AMotionInDoubtHoldsUntilClosuresContradictIt) {
  fly(20);
  const std::vector<RelativePoseFactor<KeyframeId>> elsewhere{closure_to(12, 6.0), closure_to(15, 6.0),
                                                              closure_to(18, 6.0)};
  EXPECT_FALSE(graph_.accommodate(elsewhere, keyframe_id(10))) << "the motion is known";
  graph_.doubt_motion_to(keyframe_id(10));
  graph_.optimize();
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(15)].x_m(), 15 * kStepM, 1e-6);
  ASSERT_TRUE(graph_.accommodate(elsewhere, keyframe_id(10)));
  for (const RelativePoseFactor<KeyframeId>& closure : elsewhere) graph_.add_closure(closure);
  graph_.optimize();
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(15)].x_m(), 15 * kStepM + 6.0, 0.05);
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(9)].x_m(), 9 * kStepM, 0.05);
}

/// Dead reckoning misses a part of the way to keyframe 10. What is seen contradicts the map eight keyframes
/// later only.
class MissedWayTest : public KeyframeGraphTest {
 protected:
  /// `there_m`: of the way to the keyframe where it is seen.
  void fly_and_close_loops(double missed_m, double there_m = 0.0) {
    fly(24);
    for (std::uint32_t to = 4; to < 24; ++to) {
      const double longer_m = (to < 10 ? 0.0 : missed_m) + (to < 18 ? 0.0 : there_m);
      RelativePoseFactor<KeyframeId> closure = closure_to(to, longer_m);
      closure.information *= 0.25;
      graph_.add_closure(closure);
    }
    graph_.doubt_motion_to(keyframe_id(18));
    graph_.optimize();
  }
};

TEST_F(MissedWayTest, TheDoubtGoesToTheMotionThatClosuresBend) {
  fly_and_close_loops(0.15);
  ASSERT_TRUE(graph_.release_bent_motion());
  EXPECT_FALSE(graph_.release_bent_motion()) << "there is one doubt";
  for (const std::uint32_t k : {9U, 10U, 17U, 18U}) {
    const double x_m = k * kStepM + (k < 10 ? 0.0 : 0.15);
    EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(k)].x_m(), x_m, 0.002) << k;
  }
  const std::vector<DoubtedMotion> doubted = doubted_motions(graph_.graph(), chain_);
  ASSERT_EQ(doubted.size(), 1U);
  EXPECT_EQ(doubted[0].scans.first, chain_.scan_of(keyframe_id(10)));
  EXPECT_EQ(doubted[0].weight, 0.0) << "refinement refuses it, too";
}

TEST_F(MissedWayTest, WhatLiesFartherBackIsNotAtFault) {
  config_.tuning.confidence.old_after_m = 6 * kStepM;
  fly_and_close_loops(0.15);
  EXPECT_FALSE(graph_.release_bent_motion());
}

TEST_F(MissedWayTest, ALittleReleasesNothing) {
  fly_and_close_loops(0.05);
  EXPECT_FALSE(graph_.release_bent_motion());
  EXPECT_EQ(graph_.graph().factors[graph_.graph().doubted[0]].to, keyframe_id(18));
}

TEST_F(MissedWayTest, TheDoubtStaysAtTheMotionThatClosuresBendMost) {
  fly_and_close_loops(0.18, 0.12);
  EXPECT_FALSE(graph_.release_bent_motion());
}

TEST_F(KeyframeGraphTest, AnExpectedClosureWaitsForOthersButNotForEver) {
  fly(20);
  EXPECT_TRUE(graph_.optimize());
  graph_.add_closure(closure_to(19, 0.0));
  EXPECT_FALSE(add_keyframe());
  EXPECT_EQ(graph_.state(), GraphState::kPending);
  int keyframes = 1;
  while (!add_keyframe() && keyframes < 100) ++keyframes;
  EXPECT_EQ(keyframes, 7) << "since the last optimisation 8";
  EXPECT_EQ(graph_.state(), GraphState::kSettled);
}

TEST_F(KeyframeGraphTest, AClosureThatDisagreesMovesTheGraphAtOnce) {
  fly(20);
  graph_.add_closure(closure_to(19, 0.05));
  EXPECT_TRUE(add_keyframe());
  EXPECT_GT(graph_.T_map_keyframe()[keyframe_id(19)].x_m(), 19 * kStepM + 0.01);
  EXPECT_EQ(graph_.counters().optimizations, 1U);
}

TEST_F(KeyframeGraphTest, AGroupThatAgreesMovesNothing) {
  fly(20);
  const std::vector<RelativePoseFactor<KeyframeId>> group{closure_to(17, 0.0), closure_to(19, 0.0)};
  EXPECT_TRUE(graph_.accommodate(group, keyframe_id(1)));
  EXPECT_EQ(graph_.state(), GraphState::kSettled);
}

TEST_F(KeyframeGraphTest, AGroupThatFitsMovesTheGraphToItself) {
  fly(400);
  std::vector<RelativePoseFactor<KeyframeId>> group;
  for (const std::uint32_t to : {390U, 393U, 396U, 399U}) group.push_back(closure_to(to, 0.5));
  EXPECT_TRUE(graph_.accommodate(group, keyframe_id(200)));
  EXPECT_EQ(graph_.state(), GraphState::kMoved);
  EXPECT_NEAR(graph_.T_map_keyframe()[keyframe_id(399)].x_m(), 399 * kStepM + 0.5, 0.05);
  for (const RelativePoseFactor<KeyframeId>& closure : group) graph_.add_closure(closure);
  EXPECT_TRUE(add_keyframe());
  EXPECT_EQ(graph_.state(), GraphState::kSettled);
}

TEST_F(KeyframeGraphTest, PosesThatWereMovedStayMovedWhereAClosureNoLongerCounts) {
  fly(400);
  const FactorId refuted = graph_.add_closure(closure_to(300, 0.0));
  const std::vector<RelativePoseFactor<KeyframeId>> group{closure_to(396, 0.5), closure_to(399, 0.5)};
  ASSERT_TRUE(graph_.accommodate(group, keyframe_id(200)));
  graph_.disable(refuted);
  EXPECT_EQ(graph_.state(), GraphState::kMoved);
}

TEST_F(KeyframeGraphTest, AGroupThatContradictsTheMotionIsRefused) {
  fly(20);
  const std::vector<RelativePoseFactor<KeyframeId>> group{closure_to(17, 3.0), closure_to(19, 3.0)};
  EXPECT_FALSE(graph_.accommodate(group, keyframe_id(10)));
  EXPECT_EQ(graph_.state(), GraphState::kSettled);
  EXPECT_TRUE(
      poses_near(graph_.T_map_keyframe()[keyframe_id(19)], Pose2(19 * kStepM, 0.0, 0.0), 1e-12, 1e-12));
}

TEST_F(KeyframeGraphTest, AcrossAHoleTheMotionIsUnknownAndTiesHold) {
  fly(20);
  const FactorId gone = graph_.add_closure(closure_to(10, 0.0));
  const FactorId kept = graph_.add_closure(closure_to(18, 0.0));
  IdRanges<KeyframeId> pruned;
  pruned.add({keyframe_id(9), keyframe_id(12)});
  const RelativePoseFactor<KeyframeId> tie = closure_to(12, 0.0);
  graph_.erase(pruned, std::vector{tie});
  const IdMap<FactorId, RelativePoseFactor<KeyframeId>>& factors = graph_.graph().factors;
  EXPECT_FALSE(factors.contains(gone));
  EXPECT_TRUE(factors.contains(kept));
  const RelativePoseFactor<KeyframeId>& across = factors[factors.last_id()];
  EXPECT_EQ(across.from, keyframe_id(8));
  EXPECT_EQ(across.to, keyframe_id(12));
  EXPECT_LT(across.information(0, 0), 1e-3);
  EXPECT_EQ(factors[factors.previous(factors.last_id())].to, tie.to);
  EXPECT_TRUE(graph_.optimize());
  EXPECT_TRUE(poses_near(graph_.T_map_keyframe()[keyframe_id(19)], Pose2(19 * kStepM, 0.0, 0.0), 1e-6, 1e-6));
}

TEST_F(KeyframeGraphTest, KeyframesThatAreErasedAreNoneThatWait) {
  fly(20);
  EXPECT_TRUE(graph_.optimize());
  fly(5);
  IdRanges<KeyframeId> pruned;
  pruned.add({keyframe_id(19), keyframe_id(24)});
  graph_.erase(pruned, {});
  graph_.add_closure(closure_to(24, 0.0));
  int keyframes = 1;
  while (!add_keyframe() && keyframes < 100) ++keyframes;
  EXPECT_EQ(keyframes, 8) << "behind keyframe 24";
}

}  // namespace
}  // namespace swiftlet
