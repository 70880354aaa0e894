// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/consistency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace swiftlet {
namespace {

using testing::ElementsAre;

HostTime at_s(double since_epoch_s) { return HostTime(from_seconds(since_epoch_s)); }

/// Straight on, a metre a second, with a start that is turned against the map.
std::vector<StampedPose> true_path(int metres) {
  std::vector<StampedPose> path;
  for (int i = 0; i <= metres; ++i)
    path.push_back({at_s(i), Pose2(5.0, 3.0, 0.7) * Pose2(static_cast<double>(i), 0.0, 0.0)});
  return path;
}

DoubtedPose pose_at(int metre, const Eigen::Vector3d& error, const Covariance3& covariance) {
  return {at_s(metre), static_cast<double>(metre), Pose2(metre + error.x(), error.y(), error.z()), covariance,
          true};
}

TEST(Consistency, OfPosesDrawnFromTheirCovarianceIsThree) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const Covariance3 covariance{.xx = 0.04, .yy = 0.01, .yaw_yaw = 0.0025};
  const StampedPath truth(true_path(10));
  double sum = 0.0;
  int inside = 0;
  constexpr int kRuns = 2000;
  constexpr double kChiSquareOf95Percent = 7.815;  // of three degrees of freedom
  for (int run = 0; run < kRuns; ++run) {
    const Eigen::Vector3d error(0.2 * normal(random), 0.1 * normal(random), 0.05 * normal(random));
    const std::vector<DoubtedPose> poses{pose_at(0, Eigen::Vector3d::Zero(), covariance),
                                         pose_at(10, error, covariance)};
    const auto at = consistency(poses, truth);
    ASSERT_TRUE(at[0].has_value());
    sum += at[0]->nees;
    inside += at[0]->nees < kChiSquareOf95Percent ? 1 : 0;
    EXPECT_NEAR(at[0]->error_m, std::hypot(error.x(), error.y()), 1e-9);
  }
  EXPECT_NEAR(sum / kRuns, 3.0, 4.0 * std::sqrt(6.0 / kRuns));  // variance of the chi-square: 6
  EXPECT_NEAR(inside, 0.95 * kRuns, 4.0 * std::sqrt(0.95 * 0.05 * kRuns));
}

TEST(Consistency, HasNoRowBeyondTheEndOfTheRun) {
  const Covariance3 covariance{.xx = 1.0, .yy = 1.0, .yaw_yaw = 1.0};
  std::vector<DoubtedPose> poses;
  for (int i = 0; i <= 30; ++i) poses.push_back(pose_at(i, Eigen::Vector3d::Zero(), covariance));
  const auto at = consistency(poses, StampedPath(true_path(30)));
  ASSERT_TRUE(at[0] && at[1]);
  EXPECT_EQ(at[1]->path_m, 20.0);
  EXPECT_FALSE(at[2].has_value());
}

/// A pose each second; `doubted`: in these seconds the program doubts it.
std::vector<DoubtedPose> poses_with_doubt(int duration_s, int from, int to) {
  std::vector<DoubtedPose> poses;
  for (int i = 0; i <= duration_s; ++i) {
    poses.push_back(pose_at(i, Eigen::Vector3d::Zero(), {}));
    poses.back().is_tracked = i < from || i >= to;
  }
  return poses;
}

std::vector<StampedError> errors_with_fault(int duration_s, int from, int to, double error_m) {
  std::vector<StampedError> errors;
  for (int i = 0; i <= duration_s; ++i) errors.push_back({at_s(i), i >= from && i < to ? error_m : 0.1});
  return errors;
}

TEST(CountAlarms, AnAlarmWhileThePoseIsRightIsFalse) {
  const AlarmCounts counts = count_alarms(poses_with_doubt(100, 50, 60), errors_with_fault(100, 0, 0, 0.0));
  EXPECT_EQ(counts.alarms, 1U);
  EXPECT_EQ(counts.false_alarms, 1U);
  EXPECT_EQ(counts.unjudged_alarms, 0U);
  EXPECT_EQ(counts.seconds, 100.0);
  EXPECT_EQ(counts.seconds_doubted, 10.0);
}

TEST(CountAlarms, AnAlarmAtNoKnownPlaceCannotBeJudged) {
  std::vector<StampedError> errors = errors_with_fault(100, 0, 0, 0.0);
  std::erase_if(errors, [](const StampedError& e) { return e.stamp >= at_s(45) && e.stamp <= at_s(60); });
  const AlarmCounts counts = count_alarms(poses_with_doubt(100, 50, 60), errors);
  EXPECT_EQ(counts.alarms, 1U);
  EXPECT_EQ(counts.false_alarms, 0U);
  EXPECT_EQ(counts.unjudged_alarms, 1U);
  EXPECT_EQ(count_alarms(poses_with_doubt(100, 50, 61), errors).unjudged_alarms, 0U) << "known at its end";
}

TEST(CountAlarms, OfAFaultTellHowLongItTookToNotice) {
  const AlarmCounts counts = count_alarms(poses_with_doubt(100, 43, 70), errors_with_fault(100, 40, 65, 2.0));
  EXPECT_EQ(counts.false_alarms, 0U);
  EXPECT_EQ(counts.unjudged_alarms, 0U);
  EXPECT_EQ(counts.times_off, 1U);
  EXPECT_THAT(counts.noticed_s, ElementsAre(3.0));
}

TEST(CountAlarms, AFaultThatIsNotNoticedHasNoTime) {
  const AlarmCounts counts = count_alarms(poses_with_doubt(100, 0, 0), errors_with_fault(100, 40, 65, 2.0));
  EXPECT_EQ(counts.alarms, 0U);
  EXPECT_EQ(counts.times_off, 1U);
  EXPECT_TRUE(counts.noticed_s.empty());
}

TEST(CountAlarms, ADoubtThatWasThereBeforeIsNoDelay) {
  const AlarmCounts counts = count_alarms(poses_with_doubt(100, 38, 70), errors_with_fault(100, 40, 65, 2.0));
  EXPECT_THAT(counts.noticed_s, ElementsAre(0.0));
}

}  // namespace
}  // namespace swiftlet
