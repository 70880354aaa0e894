// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/trajectory_error.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <random>
#include <vector>

namespace swiftlet {
namespace {

std::vector<Point2> random_path(std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> step(0.0, 0.3);
  std::vector<Point2> path{{0.0, 0.0}};
  for (int i = 0; i < 200; ++i)
    path.push_back({path.back().x_m + step(generator) + 0.1, path.back().y_m + step(generator)});
  return path;
}

TEST(TrajectoryError, IsZeroForAPathThatIsOnlyMovedAndTurned) {
  const std::vector<Point2> truth = random_path(1);
  const Pose2 T_estimate_truth(3.0, -7.0, 2.5);
  std::vector<Point2> estimate;
  estimate.reserve(truth.size());
  for (const Point2& p : truth) estimate.push_back(T_estimate_truth * p);
  const TrajectoryError error = trajectory_error(estimate, truth);
  EXPECT_EQ(error.pairs, truth.size());
  EXPECT_NEAR(error.rmse_m, 0.0, 1e-12);
  EXPECT_NEAR(error.T_truth_estimate.yaw_rad(), -2.5, 1e-12);
}

TEST(TrajectoryError, CountsWhatNoAlignmentMends) {
  const std::vector<Point2> truth = {{1, 0}, {0, 2}, {-1, 0}, {0, -2}};
  const std::vector<Point2> stretched = {{1.5, 0}, {0, 2}, {-1.5, 0}, {0, -2}};
  const TrajectoryError error = trajectory_error(stretched, truth);
  EXPECT_NEAR(error.rmse_m, std::sqrt((0.25 + 0.0 + 0.25 + 0.0) / 4.0), 1e-12);
  EXPECT_NEAR(error.mean_m, 0.25, 1e-12);
  EXPECT_NEAR(error.max_m, 0.5, 1e-12);
}

TEST(TrajectoryError, NoOtherAlignmentIsBetter) {
  const std::vector<Point2> truth = random_path(2);
  std::vector<Point2> estimate = random_path(3);
  const TrajectoryError best = trajectory_error(estimate, truth);
  const auto rmse_with = [&](const Pose2& T_truth_estimate) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Point2 p = T_truth_estimate * estimate[i];
      sum += std::pow(p.x_m - truth[i].x_m, 2) + std::pow(p.y_m - truth[i].y_m, 2);
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  };
  EXPECT_NEAR(rmse_with(best.T_truth_estimate), best.rmse_m, 1e-9);
  for (const double step : {-1e-3, 1e-3}) {
    const Pose2& T_best = best.T_truth_estimate;
    EXPECT_GT(rmse_with({T_best.x_m() + step, T_best.y_m(), T_best.yaw_rad()}), best.rmse_m);
    EXPECT_GT(rmse_with({T_best.x_m(), T_best.y_m() + step, T_best.yaw_rad()}), best.rmse_m);
    EXPECT_GT(rmse_with({T_best.x_m(), T_best.y_m(), T_best.yaw_rad() + step}), best.rmse_m);
  }
}

TEST(TrajectoryError, OfNothingIsNothing) { EXPECT_EQ(trajectory_error({}, {}).pairs, 0U); }

TEST(TrajectoryError, OfOnePointIsZero) {
  const std::vector<Point2> a = {{1, 2}};
  const std::vector<Point2> b = {{5, 5}};
  EXPECT_DOUBLE_EQ(trajectory_error(a, b).rmse_m, 0.0);
}

TEST(PathError, PairsPositionsByTheirStampsAndNamesThoseWithoutTruth) {
  const auto at = [](int ms) { return HostTime(std::chrono::milliseconds(ms)); };
  const StampedPath truth({{at(0), Pose2(1.0, 0.0, 0.0)},
                           {at(1000), Pose2(0.0, 2.0, 0.0)},
                           {at(1500), Pose2(50.0, 50.0, 0.0)},
                           {at(2001), Pose2(-1.0, 0.0, 0.0)},
                           {at(3000), Pose2(0.0, -2.0, 0.0)}});
  const StampedPath stretched({{at(0), Pose2(1.5, 0.0, 1.0)},
                               {at(1000), Pose2(0.0, 2.0, 1.0)},
                               {at(2000), Pose2(-1.5, 0.0, 1.0)},
                               {at(2500), Pose2(70.0, 70.0, 1.0)},
                               {at(3000), Pose2(0.0, -2.0, 1.0)}});
  const PathError error = path_error(stretched, truth);
  EXPECT_EQ(error.position.pairs, 4U);
  EXPECT_NEAR(error.position.mean_m, 0.25, 1e-12);
  EXPECT_NEAR(error.position.max_m, 0.5, 1e-12);
  EXPECT_EQ(error.stamps.exact, 3U);
  EXPECT_EQ(error.stamps.near, 1U);
  EXPECT_THAT(error.stamps.unmatched, testing::ElementsAre(at(2500)));
}

TEST(PathError, InterpolatesATruthWhoseStampsAreOthers) {
  const auto at = [](int ms) { return HostTime(std::chrono::milliseconds(ms)); };
  std::vector<StampedPose> measured;
  std::vector<StampedPose> estimated;
  for (int i = 0; i < 20; ++i) {
    measured.push_back({at(100 * i), Pose2(0.1 * i, 0.0, 0.0)});
    estimated.push_back({at(100 * i + 37), Pose2(0.1 * i + 0.037, 0.0, 0.0)});
  }
  const PathError error = path_error(StampedPath(estimated), StampedPath(measured));
  EXPECT_EQ(error.position.pairs, 19U);
  EXPECT_NEAR(error.position.max_m, 0.0, 1e-9);
  EXPECT_EQ(error.stamps.between, 19U);
  EXPECT_THAT(error.stamps.unmatched, testing::ElementsAre(at(1937)));  // beyond the truth's end
}

TEST(PathError, PairsStampsSomeMillisecondsApartWhereTheTruthIsSparse) {
  const auto at = [](int ms) { return HostTime(std::chrono::milliseconds(ms)); };
  const StampedPath measured({{at(0), Pose2(0.0, 0.0, 0.0)}, {at(5000), Pose2(3.0, 0.0, 0.0)}});
  const StampedPath estimated(
      {{at(20), Pose2(0.0, 0.0, 0.0)}, {at(2500), Pose2(9.0, 9.0, 0.0)}, {at(4985), Pose2(3.0, 0.0, 0.0)}});
  const PathError error = path_error(estimated, measured);
  EXPECT_EQ(error.position.pairs, 2U);
  EXPECT_NEAR(error.position.max_m, 0.0, 1e-9);
  EXPECT_THAT(error.stamps.unmatched, testing::ElementsAre(at(2500)));
}

}  // namespace
}  // namespace swiftlet
