// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "core/backend/pose_graph/pose_system.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

std::vector<RelativePoseFactor<PoseIndex>> random_steps(std::mt19937& random,
                                                        const std::vector<Pose2>& T_map_pose) {
  std::vector<RelativePoseFactor<PoseIndex>> steps;
  for (std::uint32_t i = 1; i < T_map_pose.size(); ++i) {
    RelativePoseFactor<PoseIndex> c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    c.T_from_to = between(T_map_pose[i - 1], T_map_pose[i]) * random_pose(random, 0.1);
    c.information = random_covariance(random, 0.5);
    steps.push_back(c);
  }
  return steps;
}

TEST(PoseChain, StepsAsAPoseSystemDoes) {
  std::mt19937 random(85);
  PoseChain chain;
  for (const std::size_t poses : {2U, 3U, 20U, 300U}) {
    std::vector<Pose2> T_map_pose;
    for (std::size_t i = 0; i < poses; ++i) T_map_pose.push_back(random_pose(random, 4.0));
    const std::vector<RelativePoseFactor<PoseIndex>> steps = random_steps(random, T_map_pose);
    PoseSystem system;
    ASSERT_TRUE(system.prepare(poses, steps));
    system.set_zero();
    chain.reset(poses);
    for (const RelativePoseFactor<PoseIndex>& c : steps) {
      system.add(c, 1.0, T_map_pose);
      chain.add(c, T_map_pose);
    }
    for (std::uint32_t i = 0; i < poses; i += 3) {
      const Eigen::Matrix3d H = random_covariance(random, 0.0);
      const Eigen::Vector3d rhs = 3.0 * random_pose(random, 1.0).vector();
      system.add(make_id<PoseIndex>(i), H, rhs);
      chain.add(make_id<PoseIndex>(i), H, rhs);
    }
    std::vector<Pose2> expected = T_map_pose;
    ASSERT_TRUE(system.step(expected));
    ASSERT_TRUE(chain.step(T_map_pose));
    for (std::size_t i = 0; i < poses; ++i)
      EXPECT_TRUE(poses_near(T_map_pose[i], expected[i], 1e-8, 1e-8)) << i << " of " << poses;
  }
}

TEST(PoseChain, SaysWhichPoseIsUnderconstrained) {
  std::mt19937 random(86);
  const std::vector<Pose2> before{Pose2(), Pose2(1.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0)};
  std::vector<Pose2> T_map_pose = before;
  PoseChain chain;
  chain.reset(before.size());
  chain.add(random_steps(random, before).front(), before);
  const Status stepped = chain.step(T_map_pose);
  ASSERT_FALSE(stepped);
  EXPECT_EQ(stepped.error().code, ErrorCode::kSolver);
  EXPECT_THAT(stepped.error().message, HasSubstr("near pose 2"));
  EXPECT_TRUE(poses_near(T_map_pose[1], before[1], 0.0, 0.0));
}

TEST(PoseChain, RefusesAStepThatIsNotFinite) {
  const std::vector<Pose2> before{Pose2(), Pose2(1.0, 0.0, 0.0)};
  std::vector<Pose2> T_map_pose = before;
  PoseChain chain;
  chain.reset(before.size());
  chain.add(PoseIndex{1}, Eigen::Matrix3d::Identity(),
            Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  const Status stepped = chain.step(T_map_pose);
  ASSERT_FALSE(stepped);
  EXPECT_EQ(stepped.error().code, ErrorCode::kSolver);
  EXPECT_TRUE(poses_near(T_map_pose[1], before[1], 0.0, 0.0));
}

}  // namespace
}  // namespace swiftlet
