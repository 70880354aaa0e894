// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/closure_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/backend/store/scan_store.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

KeyframeId keyframe(std::uint32_t i) { return static_cast<KeyframeId>(i); }

/// A hundred keyframes a metre apart along x, as dead reckoning has them.
class ClosureGroupsTest : public testing::Test {
 protected:
  ClosureGroupsTest() {
    for (std::uint32_t k = 0; k < 100; ++k) {
      FrontendStep step;
      step.has_keyframe = true;
      step.keyframe = keyframe(k);
      step.T_dead_body = step.sample.T_odom_body = Pose2(k, 0.0, 0.0);
      step.sample.starts_segment = k == 0;
      chain_.add(scans_.add(step));
      graph_.T_map_keyframe.push_back(step.T_dead_body);
      if (k == 0) continue;
      const Pose2 T_step(1.0, 0.0, 0.0);
      const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
      graph_.factors.push_back(
          {keyframe(k - 1), keyframe(k), T_step, residual_information(T_step, covariance)});
    }
  }

  /// Says that the keyframe is where `place_m` of the path was.
  static LoopClosure match(std::uint32_t query, double place_m, double sigma_along_m = 0.1) {
    const auto submap = static_cast<std::uint32_t>(place_m) / 3 * 3;
    LoopClosure closure;
    closure.from = keyframe(submap);
    closure.to = keyframe(query);
    closure.T_from_to = Pose2(place_m - submap, 0.0, 0.0);
    closure.covariance =
        Covariance3::from_matrix(Eigen::Vector3d(sigma_along_m * sigma_along_m, 0.01, 4e-4).asDiagonal());
    return closure;
  }
  std::vector<std::uint32_t> believed_after(const std::vector<LoopClosure>& found) {
    std::vector<std::uint32_t> queries;
    for (const LoopClosure& closure : groups_.add(found, graph_)) queries.push_back(index_of(closure.to));
    return queries;
  }

  ScanStore scans_{BeamLayout::multiranger()};
  KeyframeChain chain_{scans_};
  PoseGraph graph_;
  ClosureGroups groups_{chain_};
};

TEST_F(ClosureGroupsTest, SixThatAgreeOverSixMetresAreBelievedTogether) {
  for (const std::uint32_t query : {50U, 51U, 52U, 53U, 54U, 55U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty()) << "six, over five metres";
  EXPECT_EQ(groups_.waiting(), 6U);
  EXPECT_THAT(believed_after({match(56, 16)}), ElementsAre(50, 51, 52, 53, 54, 55, 56));
  EXPECT_EQ(groups_.waiting(), 0U);
}

TEST_F(ClosureGroupsTest, FiveAreTooFewHoweverFarTheyReach) {
  for (const std::uint32_t query : {50U, 55U, 60U, 65U, 70U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty());
}

TEST_F(ClosureGroupsTest, WhatTellsAnotherStoryIsLeftOut) {
  EXPECT_THAT(believed_after({match(50, 10), match(50, 21)}), IsEmpty());
  for (const std::uint32_t query : {52U, 54U, 56U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty());
  EXPECT_THAT(believed_after({match(58, 18), match(58, 30)}), IsEmpty());
  EXPECT_THAT(believed_after({match(60, 20)}), ElementsAre(50, 52, 54, 56, 58, 60));
}

TEST_F(ClosureGroupsTest, OfTwoStoriesNearlyAsGoodNeitherIsBelieved) {
  for (const std::uint32_t query : {50U, 51U, 52U, 53U})
    EXPECT_THAT(believed_after({match(query, query - 40.0), match(query, query - 25.0)}), IsEmpty());
  for (const std::uint32_t query : {55U, 56U, 57U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty()) << "up to seven against four";
  EXPECT_THAT(believed_after({match(58, 18)}), ElementsAre(50, 51, 52, 53, 55, 56, 57, 58))
      << "twice as many";
}

TEST_F(ClosureGroupsTest, ACorridorThatLeavesThePlaceAlongItOpenIsNotBelieved) {
  for (const std::uint32_t query : {50U, 52U, 54U, 56U, 58U, 60U})
    EXPECT_THAT(believed_after({match(query, query - 40.0, 50.0)}), IsEmpty());
  EXPECT_THAT(believed_after({match(62, 22.0, 0.5)}), IsEmpty()) << "with a door that one of them knows";
  EXPECT_THAT(believed_after({match(64, 24.0, 0.5)}), ElementsAre(50, 52, 54, 56, 58, 60, 62, 64))
      << "with two";
}

TEST_F(ClosureGroupsTest, WhatWasFoundThirtyMetresAgoIsForgotten) {
  for (const std::uint32_t query : {50U, 51U, 52U, 53U, 54U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty());
  EXPECT_THAT(believed_after({match(83, 43)}), IsEmpty());
  EXPECT_EQ(groups_.waiting(), 3U) << "of 53, 54 and now";
}

TEST_F(ClosureGroupsTest, NothingFoundChangesNothing) {
  believed_after({match(50, 10)});
  EXPECT_THAT(believed_after({}), IsEmpty());
  EXPECT_EQ(groups_.waiting(), 1U);
}

TEST_F(ClosureGroupsTest, WhatIsLeftAfterForgettingStillAgreesWithTheSame) {
  believed_after({match(50, 31), match(52, 33)});  // another story, forgotten by 83
  for (const std::uint32_t query : {60U, 62U, 64U, 66U})
    EXPECT_THAT(believed_after({match(query, query - 40.0)}), IsEmpty());
  EXPECT_THAT(believed_after({match(83, 43)}), IsEmpty());
  EXPECT_EQ(groups_.waiting(), 5U);
  EXPECT_THAT(believed_after({match(84, 44)}), ElementsAre(60, 62, 64, 66, 83, 84));
}

TEST_F(ClosureGroupsTest, WhatWaitsIsBoundedHoweverMuchIsFound) {
  for (std::uint32_t query = 50; query < 60; ++query) {
    std::vector<LoopClosure> stories;
    for (std::uint32_t k = 0; k < 30; ++k) stories.push_back(match(query, 3.0 * ((7 * k + 11 * query) % 16)));
    believed_after(stories);
    EXPECT_LE(groups_.waiting(), 100U + stories.size());
  }
}

}  // namespace
}  // namespace swiftlet
