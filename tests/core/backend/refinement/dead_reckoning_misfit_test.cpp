// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/dead_reckoning_misfit.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

using namespace std::chrono_literals;

constexpr double kPhi = 1.0;
constexpr double kAtMost = 0.5 * 3.0 * kPhi;  // of one motion
constexpr std::size_t kScansOfPath = 400;

/// Curves at changing speed: each systematic error shows.
Pose2 step_to(std::size_t i) {
  return {0.02 + 0.01 * static_cast<double>(i / 20 % 3), 0.0, i / 50 % 2 == 0 ? 0.03 : -0.02};
}

std::vector<Pose2> path_of_steps(double forward_scale) {
  std::vector<Pose2> path{Pose2()};
  for (std::size_t i = 1; i < kScansOfPath; ++i) {
    const Pose2 step = step_to(i);
    path.push_back(path.back() * Pose2(forward_scale * step.x_m(), step.y_m(), step.yaw_rad()));
  }
  return path;
}

/// `unwatched`: the scan before which dead reckoning was interrupted, and its variances say so.
RigidNodes dead_reckoned(const std::vector<Pose2>& T_odom_body, std::size_t unwatched = 0) {
  std::vector<TimedOdometry> odometry;
  std::vector<StepVariance> variance_to;
  for (std::size_t i = 0; i < T_odom_body.size(); ++i) {
    const bool is_break = i > 0 && i == unwatched;
    odometry.push_back({DeviceTime(100ms * static_cast<int>(i)), T_odom_body[i], is_break});
    variance_to.push_back(is_break ? StepVariance{1e6, 1e6} : StepVariance{1e-6, 1e-6});
  }
  return {std::move(odometry), std::move(variance_to), RigidNodesTuning()};
}

SystematicCovariance any_errors() { return covariance_of(systematic_prior(OdometryNoise()), false); }

TEST(DeadReckoningMisfit, IsNothingWhereThePathIsThatOfDeadReckoning) {
  const std::vector<Pose2> path = path_of_steps(1.0);
  EXPECT_NEAR(dead_reckoning_misfit(dead_reckoned(path), any_errors(), path, kPhi), 0.0, 1e-9);
}

TEST(DeadReckoningMisfit, AnErrorOfTheWholeRunCostsItsPriorAndNotEachStep) {
  const std::vector<Pose2> path = path_of_steps(1.03);
  const std::vector<Pose2> reported = path_of_steps(1.0);
  const double as_reported =
      dead_reckoning_misfit(dead_reckoned(reported), SystematicCovariance::Zero(), path, kPhi);
  const double corrected = dead_reckoning_misfit(dead_reckoned(reported), any_errors(), path, kPhi);
  EXPECT_GT(as_reported, 20.0);
  EXPECT_GT(corrected, 0.1) << "one deviation of the prior";
  EXPECT_LT(corrected, 2.0);
}

TEST(DeadReckoningMisfit, ASlipCountsAsOneNotByItsSize) {
  const std::vector<Pose2> reported = path_of_steps(1.0);
  std::vector<Pose2> path = reported;
  for (std::size_t i = 200; i < path.size(); ++i) path[i] = Pose2(3.0, 1.0, 0.5) * path[i];
  const double misfit = dead_reckoning_misfit(dead_reckoned(reported), any_errors(), path, kPhi);
  EXPECT_GT(misfit, 0.9 * kAtMost);
  EXPECT_LE(misfit, kAtMost);
}

TEST(DeadReckoningMisfit, AMotionThatWasNotMeasuredCostsNothing) {
  const std::vector<Pose2> reported = path_of_steps(1.0);
  std::vector<Pose2> path = reported;
  for (std::size_t i = 200; i < path.size(); ++i) path[i] = Pose2(3.0, 1.0, 0.5) * path[i];
  EXPECT_NEAR(dead_reckoning_misfit(dead_reckoned(reported, 200), any_errors(), path, kPhi), 0.0, 1e-3);
}

TEST(DeadReckoningMisfit, IsTheSameInEachMapFrame) {
  const std::vector<Pose2> reported = path_of_steps(1.0);
  std::vector<Pose2> path = path_of_steps(1.02);
  const double here = dead_reckoning_misfit(dead_reckoned(reported), any_errors(), path, kPhi);
  for (Pose2& T : path) T = Pose2(-40.0, 7.0, 2.0) * T;
  EXPECT_NEAR(dead_reckoning_misfit(dead_reckoned(reported), any_errors(), path, kPhi), here, 1e-6);
}

}  // namespace
}  // namespace swiftlet
