// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/line_extractor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>

#include "tests/core/frontend/room_drive.hpp"

namespace swiftlet {
namespace {

// Points of one scan and one beam, seen at a right angle unless given otherwise.
class LineExtractorTest : public testing::Test {
 protected:
  void add_wall(const Point2& from, const Point2& to, int points, std::uint8_t beam = 0) {
    for (int i = 0; i < points; ++i) {
      const double f = static_cast<double>(i) / (points - 1);
      const Point2 p{from.x_m + f * (to.x_m - from.x_m), from.y_m + f * (to.y_m - from.y_m)};
      const double length_m = distance_m(from, to);
      const Point2 direction{-(to.y_m - from.y_m) / length_m, (to.x_m - from.x_m) / length_m};
      ASSERT_TRUE(view_->points.try_push_back({p, direction, 0, beam}));
    }
  }
  const LineSegments& extracted() {
    view_->scans = view_->new_scans = 1;
    left_out_ = LineExtractor(config_, 0.02).extract(*view_, segments_);
    return segments_;
  }

  FrontendConfig config_;
  std::unique_ptr<MultiscanView> view_ = std::make_unique<MultiscanView>();
  LineSegments segments_;
  std::size_t left_out_ = 0;
};

TEST_F(LineExtractorTest, FindsAWallWithItsEnds) {
  add_wall({-1.0, 2.0}, {1.0, 2.0}, 15);
  ASSERT_EQ(extracted().size(), 1U);
  const LineSegment& wall = segments_[0];
  EXPECT_NEAR(wall.line.rho_m, 2.0, 1e-9);
  EXPECT_NEAR(wall.line.alpha_rad, kPi / 2.0, 1e-9);
  EXPECT_LT(wall.line.along_m(wall.start), wall.line.along_m(wall.end));
  EXPECT_NEAR(wall.start.x_m, 1.0, 1e-9);
  EXPECT_NEAR(wall.end.x_m, -1.0, 1e-9);
}

TEST_F(LineExtractorTest, SplitsAtACorner) {
  add_wall({2.0, -1.5}, {2.0, 1.0}, 15);
  add_wall({1.8, 1.0}, {-1.0, 1.0}, 15);
  ASSERT_EQ(extracted().size(), 2U);
  EXPECT_NEAR(segments_[0].line.alpha_rad, 0.0, 0.05);
  EXPECT_NEAR(segments_[1].line.alpha_rad, kPi / 2.0, 0.05);
}

TEST_F(LineExtractorTest, SplitsAtADoorway) {
  add_wall({-2.0, 1.0}, {-0.6, 1.0}, 10);
  add_wall({0.6, 1.0}, {2.0, 1.0}, 10);
  EXPECT_EQ(extracted().size(), 2U);
  config_.max_point_gap_m = 1.5;
  EXPECT_EQ(extracted().size(), 1U);
}

TEST_F(LineExtractorTest, PutsTogetherWhatSeveralBeamsSawOfOneWall) {
  add_wall({-1.0, 1.0}, {0.0, 1.0}, 8, 0);
  add_wall({0.1, 1.0}, {1.0, 1.0}, 8, 1);
  ASSERT_EQ(extracted().size(), 1U);
  EXPECT_NEAR(segments_[0].start.x_m - segments_[0].end.x_m, 2.0, 1e-9);
}

TEST_F(LineExtractorTest, KeepsParallelWallsApart) {
  add_wall({-1.0, 1.0}, {1.0, 1.0}, 8, 0);
  add_wall({-1.0, 1.2}, {1.0, 1.2}, 8, 1);
  EXPECT_EQ(extracted().size(), 2U);
}

TEST_F(LineExtractorTest, UsesNoShortNorSparseNorScatteredLines) {
  add_wall({-0.2, 1.0}, {0.2, 1.0}, 10, 0);   // short
  add_wall({-1.0, -1.0}, {0.0, -1.0}, 4, 1);  // sparse
  for (int i = 0; i < 12; ++i)                // scattered, though no point is far from the chord
    add_wall({0.1 * i + 3.0, i % 2 == 0 ? 3.0 : 3.095}, {0.1 * i + 3.05, i % 2 == 0 ? 3.0 : 3.095}, 2, 2);
  EXPECT_EQ(extracted().size(), 0U);
}

TEST_F(LineExtractorTest, UsesNoLineThatItsBeamOnlyGrazes) {
  add_wall({1.0, 0.0}, {2.0, 0.0}, 10);
  for (MultiscanPoint& point : view_->points) point.direction = {1.0, 0.05};
  EXPECT_EQ(extracted().size(), 0U);
}

TEST_F(LineExtractorTest, FindsNothingInNothing) { EXPECT_EQ(extracted().size(), 0U); }

TEST_F(LineExtractorTest, CountsWhatItHasNoRoomFor) {
  config_.min_line_points = 3;
  for (int i = 0; i < 40; ++i) add_wall({-1.0, 1.0 + i}, {1.0, 1.0 + i}, 6, static_cast<std::uint8_t>(i));
  EXPECT_EQ(extracted().size(), kMaxLinesPerMultiscan);
  EXPECT_EQ(left_out_, 40 - kMaxLinesPerMultiscan);
}

// Eqs. (15) to (18): over many drives along a wall, with noise on ranges and motions, the squared Mahalanobis
// distance of the extracted line from the true one must have the mean of two degrees of freedom.
TEST(LineCovariance, TellsHowFarLinesAreFromTheTruth) {
  const std::vector<test::RoomWall> walls{{{-10.0, 1.5}, {10.0, 1.5}}};
  FrontendConfig config;
  config.wall_sigma_m = config.wall_sigma_rad = 1e-9;
  SensorModel sensor;
  sensor.odometry.yaw_rad.after_metre = radians(2.0);  // enough for the motions to matter
  test::RandomGeometry random(7);
  LineExtractor extractor(config, sensor.range_sigma_m);
  auto view = std::make_unique<MultiscanView>();
  constexpr int kDrives = 1500;
  double sum = 0.0;
  int found = 0;
  for (int drive = 0; drive < kDrives; ++drive) {
    Multiscan multiscan(sensor, BeamLayout::multiranger(), 120);
    const Pose2 true_step(0.05, 0.0, 0.0);
    const UncertainMotion step = uncertain_step(sensor.odometry, true_step, std::chrono::milliseconds(100));
    Pose2 T_room_body;
    for (int i = 0; i < 30; ++i) {
      if (i > 0) T_room_body = T_room_body * true_step;
      const double sigma_xy_m = std::sqrt(step.covariance(0, 0));
      const Pose2 measured(true_step.x_m() + random.normal(sigma_xy_m), random.normal(sigma_xy_m),
                           random.normal(std::sqrt(step.covariance(2, 2))));
      multiscan.add(test::sense(walls, T_room_body, BeamLayout::multiranger(), sensor, random),
                    {measured, step.covariance});
    }
    multiscan.assemble(*view);
    LineSegments segments;
    extractor.extract(*view, segments);
    if (segments.size() != 1) continue;
    ++found;
    const Eigen::Vector2d error(segments[0].line.rho_m - 1.5,
                                wrap_angle(segments[0].line.alpha_rad - kPi / 2.0));
    sum += error.dot(segments[0].covariance.inverse() * error);
  }
  EXPECT_GT(found, kDrives * 9 / 10);
  EXPECT_NEAR(sum / found, 2.0, 0.25);
}

}  // namespace
}  // namespace swiftlet
