// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/correlative_matcher.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/drawn_submap.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr double kCellM = 0.1;
constexpr int kKernelCells = 3;
constexpr double kHalfCellM = 0.5 * kCellM;
constexpr double kYawToleranceRad = radians(1.0);

// 4 m by 2 m, with nooks, so that no two places and no two headings look alike.
const std::vector<std::string> kRoom{"########################################",  //
                                     "#....................###...............#",  //
                                     "#....................###...............#",  //
                                     "#....................###...............#",  //
                                     "#......................................#",  //
                                     "#......................................#",  //
                                     "#......................................#",  //
                                     "#......................................#",  //
                                     "###....................................#",  //
                                     "###....................................#",  //
                                     "###....................................#",  //
                                     "#......................................#",  //
                                     "#......................................#",  //
                                     "#................................#######",  //
                                     "#................................#######",  //
                                     "#................................#######",  //
                                     "#.........######.................#######",  //
                                     "#.........######.................#######",  //
                                     "#.........######.................#######",  //
                                     "########################################"};

std::vector<std::string> turned_left(const std::vector<std::string>& picture) {
  std::vector<std::string> turned(picture[0].size(), std::string(picture.size(), ' '));
  for (std::size_t line = 0; line < picture.size(); ++line) {
    for (std::size_t column = 0; column < picture[0].size(); ++column)
      turned[picture[0].size() - 1 - column][line] = picture[line][column];
  }
  return turned;
}

std::vector<std::string> mirrored(const std::vector<std::string>& picture) {
  return {picture.rbegin(), picture.rend()};
}

Submap submap_of(const std::vector<std::string>& picture) {
  return drawn_submap(picture, kCellM, kKernelCells);
}

bool is_wall(const std::vector<std::string>& picture, std::size_t line, std::size_t column) {
  return line < picture.size() && column < picture[line].size() && picture[line][column] == '#';
}

/// The middles of all wall cells that border on free space, in the submap's frame.
std::vector<Point2> wall_points(const std::vector<std::string>& picture) {
  const Submap submap = submap_of(picture);
  std::vector<Point2> points;
  for (std::size_t line = 0; line < picture.size(); ++line) {
    for (std::size_t column = 0; column < picture[0].size(); ++column) {
      if (!is_wall(picture, line, column)) continue;
      const bool inside = is_wall(picture, line - 1, column) && is_wall(picture, line + 1, column) &&
                          is_wall(picture, line, column - 1) && is_wall(picture, line, column + 1);
      if (inside) continue;
      points.push_back(
          submap.geometry.center({static_cast<int>(column), static_cast<int>(picture.size() - 1 - line)}));
    }
  }
  return points;
}

std::vector<Point2> seen_from(const Pose2& T_submap_scan, const std::vector<Point2>& points_submap) {
  std::vector<Point2> points;
  points.reserve(points_submap.size());
  for (const Point2& p : points_submap) points.push_back(T_submap_scan.inverse() * p);
  return points;
}

std::optional<MatchResult> match(const Submap& submap, const std::vector<Point2>& points_scan,
                                 const Pose2& predicted, double min_score = 0.5) {
  return CorrelativeMatcher(submap, points_scan, {predicted, 0.8, 0.3}).match(min_score);
}

std::vector<std::string> random_picture(std::mt19937& random) {
  const auto width = static_cast<std::size_t>(random_int(random, 15, 45));
  const auto height = static_cast<std::size_t>(random_int(random, 15, 45));
  std::vector<std::string> picture(height, std::string(width, ' '));
  for (int stroke = 0; stroke < 25; ++stroke) {
    const auto line = static_cast<std::size_t>(random_int(random, 0, static_cast<int>(height) - 1));
    const auto column = static_cast<std::size_t>(random_int(random, 0, static_cast<int>(width) - 1));
    const auto length = static_cast<std::size_t>(random_int(random, 2, 20));
    const char mark = random_int(random, 0, 2) == 0 ? '.' : '#';
    const bool level = random_int(random, 0, 1) == 0;
    for (std::size_t k = 0; k < length; ++k) {
      const std::size_t at_line = level ? line : line + k;
      const std::size_t at_column = level ? column + k : column;
      if (at_line < height && at_column < width) picture[at_line][at_column] = mark;
    }
  }
  return picture;
}

TEST(CorrelativeMatcher, BranchAndBoundEqualsExhaustionInRandomRooms) {
  std::mt19937 random(42);
  int found = 0;
  for (int room = 0; room < 60; ++room) {
    const int kernel_cells = 2 * random_int(random, 0, 2) + 1;
    const Submap submap = drawn_submap(random_picture(random), kCellM, kernel_cells);
    std::vector<Point2> points;
    for (int i = random_int(random, 5, 40); i > 0; --i)
      points.push_back({random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)});
    const Pose2 predicted = random_pose(random, 0.5);
    const SearchWindow window{predicted, random_in(random, 0.05, 1.2), random_in(random, 0.01, 0.5)};
    const CorrelativeMatcher matcher(submap, points, window);
    const double min_score = random_in(random, 0.0, 0.4);
    const auto fast = matcher.best_by_branch_and_bound(min_score);
    const auto slow = matcher.best_by_exhaustion(min_score);
    ASSERT_EQ(fast.has_value(), slow.has_value()) << "room " << room;
    if (!fast) continue;
    ++found;
    ASSERT_EQ(fast->preferred, slow->preferred) << "room " << room;
    const bool same_pose = fast->steps_x == slow->steps_x && fast->steps_y == slow->steps_y &&
                           fast->steps_yaw == slow->steps_yaw;
    const int fast_way = fast->steps_x * fast->steps_x + fast->steps_y * fast->steps_y;
    const int slow_way = slow->steps_x * slow->steps_x + slow->steps_y * slow->steps_y;
    ASSERT_TRUE(same_pose || (fast->score == slow->score && fast_way == slow_way))
        << "no exact tie: room " << room;
  }
  EXPECT_GT(found, 30) << "the rooms decide something";
}

TEST(CorrelativeMatcher, OneAngularStepTurnsTheFarthestPointByOneCell) {
  const Submap submap = submap_of(kRoom);
  const std::vector<Point2> points{{0.5, 0.0}, {-1.2, 1.6}};
  const CorrelativeMatcher matcher(submap, points, {});
  EXPECT_NEAR(2.0 * 2.0 * std::sin(0.5 * matcher.angle_step_rad()), kCellM, 1e-9);
}

TEST(CorrelativeMatcher, StepsAreCellsAndAnglesFromThePrediction) {
  const Submap submap = submap_of(kRoom);
  const std::vector<Point2> points{{1.0, 0.0}};
  const Pose2 predicted(0.3, -0.2, 0.5);
  const CorrelativeMatcher matcher(submap, points, {predicted, 1.0, 0.5});
  EXPECT_TRUE(poses_near(matcher.T_submap_scan({}), predicted, 1e-12, 1e-12));
  EXPECT_TRUE(poses_near(matcher.T_submap_scan({.steps_x = 2, .steps_y = -3, .steps_yaw = 4}),
                         Pose2(0.5, -0.5, 0.5 + 4.0 * matcher.angle_step_rad()), 1e-12, 1e-12));
}

TEST(CorrelativeMatcher, RecoversADisplacementToHalfACellAndAnAngularStep) {
  std::mt19937 random(81);
  const Submap submap = submap_of(kRoom);
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth(random_in(random, -1.0, 1.0), random_in(random, -0.3, 0.3),
                      random_in(random, -kPi, kPi));
    const Pose2 predicted(truth.x_m() + random_in(random, -0.5, 0.5),
                          truth.y_m() + random_in(random, -0.5, 0.5),
                          truth.yaw_rad() + random_in(random, -0.2, 0.2));
    const CorrelativeMatcher matcher(submap, seen_from(truth, wall_points(kRoom)), {predicted, 0.8, 0.3});
    const auto result = matcher.match(0.5);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->T_submap_scan.x_m(), truth.x_m(), kHalfCellM);
    EXPECT_NEAR(result->T_submap_scan.y_m(), truth.y_m(), kHalfCellM);
    EXPECT_NEAR(wrap_angle(result->T_submap_scan.yaw_rad() - truth.yaw_rad()), 0.0, matcher.angle_step_rad());
    EXPECT_GT(result->score, 0.8);
  }
}

TEST(CorrelativeMatcher, TheAnswerToAScanSeenFromElsewhereMovesAlong) {
  const Submap submap = submap_of(kRoom);
  const std::vector<Point2> points = wall_points(kRoom);
  const Pose2 truth(0.2, 0.1, 0.4);
  const Pose2 T_scan_other(0.6, -0.3, 1.9);
  const Pose2 predicted = Pose2(0.3, -0.2, 0.1) * truth;
  const auto one = match(submap, seen_from(truth, points), predicted);
  const auto other = match(submap, seen_from(truth * T_scan_other, points), predicted * T_scan_other);
  ASSERT_TRUE(one && other);
  EXPECT_TRUE(poses_near(other->T_submap_scan, one->T_submap_scan * T_scan_other, kCellM, kYawToleranceRad));
}

TEST(CorrelativeMatcher, TheAnswerTurnsWithTheRoom) {
  const std::vector<std::string> turned = turned_left(kRoom);
  const Pose2 T_turned_room(0.0, 0.0, kPi / 2.0);
  const Pose2 truth(0.33, -0.12, 0.4);
  const Pose2 predicted(0.0, 0.1, 0.3);
  const std::vector<Point2> points = seen_from(truth, wall_points(kRoom));
  const auto one = match(submap_of(kRoom), points, predicted);
  const auto other = match(submap_of(turned), points, T_turned_room * predicted);
  ASSERT_TRUE(one && other);
  EXPECT_TRUE(
      poses_near(other->T_submap_scan, T_turned_room * one->T_submap_scan, kHalfCellM, kYawToleranceRad));
  EXPECT_NEAR(other->score, one->score, 0.02);
}

TEST(CorrelativeMatcher, TheAnswerIsMirroredWithTheRoom) {
  const auto mirror = [](const Pose2& pose) { return Pose2(pose.x_m(), -pose.y_m(), -pose.yaw_rad()); };
  const Pose2 truth(-0.41, 0.23, 0.7);
  const Pose2 predicted(-0.2, 0.1, 0.6);
  const std::vector<Point2> points = seen_from(truth, wall_points(kRoom));
  std::vector<Point2> mirrored_points;
  mirrored_points.reserve(points.size());
  for (const Point2& p : points) mirrored_points.push_back({p.x_m, -p.y_m});
  const auto one = match(submap_of(kRoom), points, predicted);
  const auto other = match(submap_of(mirrored(kRoom)), mirrored_points, mirror(predicted));
  ASSERT_TRUE(one && other);
  EXPECT_TRUE(poses_near(other->T_submap_scan, mirror(one->T_submap_scan), kHalfCellM, kYawToleranceRad));
  EXPECT_NEAR(other->score, one->score, 0.02);
}

/// 10 m of two straight walls and nothing else, and the middle third of them as seen by the scan.
class CorrelativeMatcherInACorridor : public testing::Test {
 protected:
  CorrelativeMatcherInACorridor() {
    for (int i = -15; i <= 15; ++i) {
      points_.push_back({0.1 * i, 0.95});
      points_.push_back({0.1 * i, -0.95});
    }
  }
  static std::vector<std::string> corridor() {
    std::vector<std::string> picture(20, std::string(100, '.'));
    picture.front() = picture.back() = std::string(100, '#');
    return picture;
  }
  Submap submap_ = submap_of(corridor());
  std::vector<Point2> points_;
};

TEST_F(CorrelativeMatcherInACorridor, IsSureAcrossAndUnsureAlong) {
  const auto result = match(submap_, points_, Pose2(0.5, 0.3, 0.1));
  ASSERT_TRUE(result);
  const Eigen::Matrix3d& P = result->covariance;
  EXPECT_GT(std::sqrt(P(0, 0)), 0.5) << "along";
  EXPECT_LT(std::sqrt(P(1, 1)), 0.15) << "across";
  EXPECT_LT(std::abs(P(0, 1)), 0.1 * P(0, 0));
}

TEST_F(CorrelativeMatcherInACorridor, IsUnsureAlongInWhicheverDirectionItRuns) {
  const auto result = match(submap_of(turned_left(corridor())), points_, Pose2(0.3, 0.5, kPi / 2.0 + 0.1));
  ASSERT_TRUE(result);
  EXPECT_GT(std::sqrt(result->covariance(1, 1)), 0.5) << "along";
  EXPECT_LT(std::sqrt(result->covariance(0, 0)), 0.15) << "across";
}

TEST_F(CorrelativeMatcherInACorridor, ThePoseNearestThePredictionWins) {
  for (const double x_m : {-0.6, 0.0, 0.9}) {
    const auto result = match(submap_, points_, Pose2(x_m, 0.3, 0.0));
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->T_submap_scan.x_m(), x_m, kCellM);
    EXPECT_NEAR(result->T_submap_scan.y_m(), 0.0, kHalfCellM);
  }
}

TEST(CorrelativeMatcher, CovariancesArePositiveDefinite) {
  std::mt19937 random(82);
  const Submap submap = submap_of(kRoom);
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth(random_in(random, -1.0, 1.0), random_in(random, -0.3, 0.3),
                      random_in(random, -kPi, kPi));
    const auto result = match(submap, seen_from(truth, wall_points(kRoom)), truth);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->covariance.isApprox(result->covariance.transpose()));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(result->covariance);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 1e-6);
  }
}

TEST(CorrelativeMatcher, AnswersNothingBelowTheLeastScore) {
  const Submap submap = submap_of(kRoom);
  // Three quarters of the scan fit, the rest lies outside of everything.
  std::vector<Point2> points = wall_points(kRoom);
  const std::size_t fitting = points.size();
  for (std::size_t i = 0; 3 * i < fitting; ++i) points.push_back({50.0 + 0.01 * static_cast<double>(i), 0.0});
  const SearchWindow window{Pose2(), 0.3, 0.001};
  const CorrelativeMatcher matcher(submap, points, window);
  const auto best = matcher.match(0.1);
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->score, 0.75 * 240.0 / 255.0, 0.01);
  EXPECT_TRUE(matcher.match(best->score));
  EXPECT_FALSE(matcher.match(best->score + 1e-6));
  EXPECT_FALSE(matcher.best_by_exhaustion(best->score + 1e-6));
}

TEST(CorrelativeMatcher, AnswersNothingWhereHalfOfTheScanLiesOnUnknownGround) {
  std::vector<Point2> points = wall_points(kRoom);
  const std::size_t fitting = points.size();
  for (std::size_t i = 0; i < fitting; ++i) points.push_back({50.0 + 0.01 * static_cast<double>(i), 0.0});
  EXPECT_FALSE(match(submap_of(kRoom), points, Pose2(), 0.1));
}

TEST(CorrelativeMatcher, AnswersNothingWhereTheSubmapIsOutOfReach) {
  const Submap submap = submap_of(kRoom);
  EXPECT_FALSE(match(submap, wall_points(kRoom), Pose2(30.0, 0.0, 0.0), 0.01));
}

TEST(CorrelativeMatcher, TheAnswerStaysInItsWindow) {
  const Submap submap = submap_of(kRoom);
  const std::vector<Point2> points = wall_points(kRoom);
  // The true place lies 1 m beside the window.
  const SearchWindow window{Pose2(1.3, 0.0, 0.0), 0.3, 0.1};
  const auto best = CorrelativeMatcher(submap, points, window).best_by_branch_and_bound(0.01);
  ASSERT_TRUE(best);
  EXPECT_LE(std::abs(best->steps_x), 3);
  EXPECT_LE(std::abs(best->steps_y), 3);
}

TEST_F(CorrelativeMatcherInACorridor, AShortSubmapsEndsAreNoEvidenceOfThePosition) {
  for (const std::size_t cells : {40U, 60U, 100U}) {
    std::vector<std::string> picture(20, std::string(cells, '.'));
    picture.front() = picture.back() = std::string(cells, '#');
    const auto result = match(submap_of(picture), points_, Pose2(0.2, 0.1, 0.05));
    ASSERT_TRUE(result);
    EXPECT_GT(std::sqrt(result->covariance(0, 0)), 2.0) << cells << " cells long: it may lie anywhere along";
    EXPECT_LT(std::sqrt(result->covariance(1, 1)), 0.15);
  }
}

TEST_F(CorrelativeMatcherInACorridor, TheMeanStaysOnTheWalls) {
  // Moved across by the corridor's width, one of the walls lies on the other and the rest on unknown ground.
  const SearchWindow window{Pose2(0.2, 0.1, 0.0), 3.0, 0.1};
  const auto result = CorrelativeMatcher(submap_, points_, window).match(0.5);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->T_submap_scan.y_m(), 0.0, kHalfCellM);
  EXPECT_LT(std::sqrt(result->covariance(1, 1)), 0.15);
}

TEST_F(CorrelativeMatcherInACorridor, AHundredMatchesOfAPassageDoNotAddUpToAPlaceAlongIt) {
  const SearchWindow window{Pose2(0.2, 0.1, 0.0), 3.0, 0.1};
  const auto result = CorrelativeMatcher(submap_, points_, window).match(0.5);
  ASSERT_TRUE(result);
  EXPECT_GT(std::sqrt(result->covariance(0, 0) / 100.0), 3.0);
}

TEST_F(CorrelativeMatcherInACorridor, AScanDrawnToTheWindowsEdgeByWhatTheSubmapCoversIsNoMatch) {
  // In truth all of it may lie where the submap knows nothing.
  for (const double predicted_x_m : {-6.05, 6.05}) {
    const CorrelativeMatcher matcher(submap_, points_, {Pose2(predicted_x_m, 0.0, 0.0), 2.0, 0.1});
    const auto best = matcher.best_by_branch_and_bound(0.5);
    ASSERT_TRUE(best);
    EXPECT_EQ(std::abs(best->steps_x), 20);
    EXPECT_FALSE(matcher.match(0.5));
  }
}

TEST(CorrelativeMatcher, ARoomsEndsAreEvidenceOfThePosition) {
  const Submap room = submap_of(kRoom);
  const auto result = match(room, wall_points(kRoom), Pose2(0.1, -0.1, 0.02));
  ASSERT_TRUE(result);
  EXPECT_LT(std::sqrt(result->covariance(0, 0)), 0.2);
  EXPECT_LT(std::sqrt(result->covariance(1, 1)), 0.2);
}

}  // namespace
}  // namespace swiftlet
