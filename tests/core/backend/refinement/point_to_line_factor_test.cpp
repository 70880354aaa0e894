// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/point_to_line_factor.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include "core/backend/store/traversal.hpp"
#include "core/sensing/odometry_covariance.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

LocalWall random_wall(std::mt19937& random) {
  const double direction_rad = random_in(random, -kPi, kPi);
  return {{random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)},
          {std::cos(direction_rad), std::sin(direction_rad)}};
}

/// A wall along x that lies `off_m` below the return which a body at the origin sees 1 m ahead.
LocalWall wall_below(double off_m) { return {{0.0, -off_m}, {0.0, 1.0}}; }
constexpr Point2 kAhead{1.0, 0.0};

TEST(WallFactor, PullsDownTheSlopeOfTheDistance) {
  std::mt19937 random(41);
  for (int trial = 0; trial < 50; ++trial) {
    const LocalWall wall = random_wall(random);
    const Pose2 T = random_pose(random, 2.0);
    const Point2 p{random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)};
    const PointToLineFactor pull = point_to_line_factor(wall, T, p, {});
    Eigen::Vector3d slope;
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d up = T.vector();
      Eigen::Vector3d down = T.vector();
      up(k) += kStep;
      down(k) -= kStep;
      slope(k) = (distance_m(wall, Pose2(up(0), up(1), up(2)) * p) -
                  distance_m(wall, Pose2(down(0), down(1), down(2)) * p)) /
                 (2.0 * kStep);
    }
    const double weight = pull.H.trace() / slope.squaredNorm();
    EXPECT_GT(weight, 0.0);
    EXPECT_LT((pull.H - weight * slope * slope.transpose()).norm(), 1e-6 * pull.H.norm());
    EXPECT_LT((pull.rhs + weight * distance_m(wall, T * p) * slope).norm(), 1e-6 * (1.0 + pull.rhs.norm()));
  }
}

TEST(WallFactor, WhatLiesFarOffHasLessSayThanWhatLiesNear) {
  const double near = point_to_line_factor(wall_below(0.05), {}, kAhead, {}).rhs.norm();
  EXPECT_GT(near, 3.0 * point_to_line_factor(wall_below(0.3), {}, kAhead, {}).rhs.norm());
  EXPECT_GT(near, 100.0 * point_to_line_factor(wall_below(1.0), {}, kAhead, {}).rhs.norm());
}

TEST(WallFactor, AJudgeCapsDistancesAndCountsNoWallFull) {
  EXPECT_DOUBLE_EQ(judged_distance_m(wall_below(0.04), kAhead, {}), 0.04);
  EXPECT_DOUBLE_EQ(judged_distance_m(wall_below(-0.04), kAhead, {}), 0.04);
  EXPECT_DOUBLE_EQ(judged_distance_m(wall_below(2.0), kAhead, {}),
                   judged_distance_m(std::nullopt, kAhead, {}));
  EXPECT_GT(judged_distance_m(std::nullopt, kAhead, {}), 0.1);
}

TEST(WallFactor, DeadReckoningIsBelievedLessTheMoreItMovedAndTheLessItSaw) {
  const OdometryNoise noise = SensorModel::crazyflie().odometry;
  const StoredScan from{};
  StoredScan to{};
  to.measured_at = from.measured_at + std::chrono::seconds(2);
  const double at_rest = motion_information(from, to, noise)(0, 0);
  EXPECT_DOUBLE_EQ(at_rest, 1.0 / (2.0 * noise.xy_m.after_second * noise.xy_m.after_second));
  to.T_dead_body = Pose2(0.5, 0.0, 0.2);
  const Eigen::Matrix3d moved = motion_information(from, to, noise);
  to.starts_segment = true;
  to.odometry_ran_on = true;
  const Eigen::Matrix3d unwatched = motion_information(from, to, noise);
  to.odometry_ran_on = false;
  const Eigen::Matrix3d began_anew = motion_information(from, to, noise);
  EXPECT_EQ(began_anew.diagonal(), kUnknownMotion.information());
  for (const int k : {0, 2}) {
    EXPECT_GT(motion_information(from, from, noise)(k, k), 2.0 * moved(k, k));
    EXPECT_GT(moved(k, k), 1.5 * unwatched(k, k));
    EXPECT_GT(unwatched(k, k), 100.0 * began_anew(k, k));
  }
}

TEST(WallFactor, APassIsAFewKeyframes) {
  StoredScan scan{};
  for (std::uint32_t k = 0; k < 3 * kKeyframesPerTraversal; ++k) {
    scan.keyframe = make_id<KeyframeId>(k);
    EXPECT_EQ(index_of(traversal_of(scan)), k / 3);
  }
}

}  // namespace
}  // namespace swiftlet
