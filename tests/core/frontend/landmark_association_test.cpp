// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_association.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swiftlet {
namespace {

constexpr KeyframeId kNow{10};

// The wall y = 1 from x = 0 to 3, seen from below.
Landmark wall_at(double y_m, double x_from_m = 0.0, double x_to_m = 3.0) {
  Landmark landmark;
  landmark.line_local = {y_m, kPi / 2.0};
  landmark.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
  landmark.start_local = {x_from_m, y_m};
  landmark.end_local = {x_to_m, y_m};
  landmark.last_seen = KeyframeId{9};
  return landmark;
}

LineSegment segment_between(const Point2& a, const Point2& b) {
  LineFit fit;
  fit.add(a);
  fit.add(b);
  LineSegment segment;
  segment.line = fit.line();
  segment.covariance = Eigen::Vector2d(4e-4, 4e-4).asDiagonal();
  segment.start = a;
  segment.end = b;
  return segment;
}

std::optional<std::size_t> associated(const std::vector<Landmark>& landmarks, const LineSegment& segment,
                                      const FrontendConfig& config = {}, KeyframeId oldest = KeyframeId{0}) {
  const Viewpoint viewpoint{Pose2(), Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal()};
  return associate(landmarks, segment, viewpoint, oldest, config);
}

TEST(Association, TakesTheNearestOfTheWallsInReach) {
  EXPECT_EQ(associated({wall_at(1.1), wall_at(0.98), wall_at(1.06)}, segment_between({1.0, 1.0}, {2.0, 1.0})),
            1U);
}

TEST(Association, TakesNoWallBeyondTheProjectionError) {
  FrontendConfig config;
  config.association_error_m = 0.1;
  const LineSegment segment = segment_between({1.0, 1.0}, {2.0, 1.0});
  EXPECT_EQ(associated({wall_at(1.04)}, segment, config), 0U);
  EXPECT_EQ(associated({wall_at(1.06)}, segment, config), std::nullopt);
}

TEST(Association, TakesNoWallThatDoesNotOverlap) {
  FrontendConfig config;
  const LineSegment segment = segment_between({3.2, 1.0}, {4.2, 1.0});
  EXPECT_EQ(associated({wall_at(1.0)}, segment, config), std::nullopt);
  config.association_gap_m = 0.3;
  EXPECT_EQ(associated({wall_at(1.0)}, segment, config), 0U);
}

TEST(Association, TakesNoShortSegmentAcrossAWall) {
  // Its end points lie within the projection error at an angle of 27 degrees.
  EXPECT_EQ(associated({wall_at(1.0)}, segment_between({1.0, 0.9}, {1.4, 1.1})), std::nullopt);
}

TEST(Association, TakesNoWallSeenFromItsOtherSide) {
  Landmark other_face = wall_at(1.0);
  other_face.seen_from_local = {1.0, 2.0};
  EXPECT_EQ(associated({other_face}, segment_between({1.0, 1.0}, {2.0, 1.0})), std::nullopt);
}

TEST(Association, TakesNoWallSeenTooLongAgo) {
  const std::vector<Landmark> walls{wall_at(1.0)};
  const LineSegment segment = segment_between({1.0, 1.0}, {2.0, 1.0});
  EXPECT_EQ(associated(walls, segment, {}, KeyframeId{9}), 0U);
  EXPECT_EQ(associated(walls, segment, {}, kNow), std::nullopt);
}

TEST(Association, FindsNothingAmongNoWalls) {
  EXPECT_EQ(associated({}, segment_between({1.0, 1.0}, {2.0, 1.0})), std::nullopt);
}

}  // namespace
}  // namespace swiftlet
