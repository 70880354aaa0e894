// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/refinement_problem.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swiftlet {
namespace {

constexpr double kRadiusM = 0.4;
constexpr StoreyId kBelow{0};
constexpr StoreyId kAbove{1};

/// Two traversals along y = 0 below, one along y = 0.1 above.
RefinementProblem two_storeys() {
  RefinementProblem problem{RefinementTuning{}};
  for (const std::uint32_t traversal : {0U, 1U, 2U})
    for (int i = 0; i < 40; ++i)
      problem.add({PoseIndex{0},
                   traversal,
                   traversal < 2 ? kBelow : kAbove,
                   false,
                   {0.02 * i, traversal < 2 ? 0.0 : 0.1}});
  return problem;
}

TEST(RefinementProblem, AWallIsThatOfItsOwnStorey) {
  const WallsByStorey walls = two_storeys().walls_at({Pose2()}, kRadiusM);
  const auto below = walls.wall_near(kBelow, {{0.4, 0.05}, 7});
  EXPECT_NEAR(below.value().center_map.y_m, 0.0, 1e-9);
  const auto above = walls.wall_near(kAbove, {{0.4, 0.05}, 7});
  EXPECT_NEAR(above.value().center_map.y_m, 0.1, 1e-9);
  EXPECT_FALSE(walls.wall_near(kAbove, {{0.4, 0.05}, 2}).has_value()) << "no other traversal was there";
}

TEST(RefinementProblem, ThinningLeavesSomeOfTheReturnsThatJudge) {
  const RefinementTuning tuning;
  for (const std::size_t count :
       {std::size_t{900}, std::size_t{3190}, std::size_t{4200}, std::size_t{18000}}) {
    const std::size_t every = thinned_by(count, tuning.max_window_returns, tuning);
    EXPECT_LE(count / every, tuning.max_window_returns);
    for (std::uint32_t first = 0; first < tuning.hold_out_every; ++first) {
      std::size_t left = 0;
      std::size_t held_out = 0;
      for (std::uint32_t scan = 0; scan < 300; ++scan) {
        for (std::uint8_t beam = 0; beam < 11; ++beam) {
          if ((scan + beam) % every != 0) continue;
          ++left;
          held_out += is_held_out(make_id<ScanId>(first + scan), beam, tuning) ? 1U : 0U;
        }
      }
      EXPECT_NEAR(static_cast<double>(held_out) / static_cast<double>(left), 0.1, 0.02)
          << count << " returns from scan " << first;
    }
  }
}

TEST(RefinementProblem, PointsOfOthersAddToTheirStorey) {
  std::vector<TraversalPoint> others(40, TraversalPoint{{0.0, 0.1}, 9});
  for (std::size_t i = 0; i < others.size(); ++i) others[i].p_map.x_m = 0.02 * static_cast<double>(i);
  const WallsByStorey walls = two_storeys().walls_at({Pose2()}, kRadiusM, others, kAbove);
  EXPECT_TRUE(walls.wall_near(kAbove, {{0.4, 0.05}, 2}).has_value());
  EXPECT_NEAR(walls.wall_near(kBelow, {{0.4, 0.05}, 7}).value().center_map.y_m, 0.0, 1e-9);
}

}  // namespace
}  // namespace swiftlet
