// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_graph.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

using TinyGraph = LandmarkGraph<LandmarkGraphCapacity{3, 2, 4}>;

UncertainMotion forward(double x_m) {
  return uncertain_step(OdometryNoise(), Pose2(x_m, 0.0, 0.0), std::chrono::milliseconds(100));
}

// The wall y = 1 between two places along x, as seen from a pose on the x axis.
LineSegment wall_segment(double x_from_m, double x_to_m, double y_m = 1.0) {
  LineSegment segment;
  segment.line = {y_m, kPi / 2.0};
  segment.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
  segment.start = {x_from_m, y_m};
  segment.end = {x_to_m, y_m};
  return segment;
}

TinyGraph graph_of_one_pose() {
  TinyGraph graph;
  graph.add_first_pose(KeyframeId{0}, Pose2());
  return graph;
}

TEST(LandmarkGraph, PlacesANewPoseByItsMotion) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{2}, forward(0.5)));
  EXPECT_NEAR(graph.poses()[2].T_local_body.x_m(), 1.0, 1e-12);
  EXPECT_NEAR(graph.chi_square(), 0.0, 1e-12);
}

TEST(LandmarkGraph, RefusesWhatDoesNotFitAndStaysAsItWas) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{1}, wall_segment(0.0, 1.0, 2.0)));
  EXPECT_FALSE(graph.try_add_landmark(LandmarkId{2}, wall_segment(0.0, 1.0, 3.0)));
  ASSERT_TRUE(graph.try_observe(0, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_observe(1, wall_segment(0.0, 1.0)));
  EXPECT_FALSE(graph.try_observe(0, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{2}, forward(0.5)));
  EXPECT_FALSE(graph.try_add_pose(KeyframeId{3}, forward(0.5)));
  EXPECT_EQ(graph.poses().size(), 3U);
  EXPECT_EQ(graph.landmarks().size(), 2U);
  EXPECT_EQ(graph.observations().size(), 4U);
  EXPECT_EQ(graph.landmarks()[0].observation_count, 2U);
}

TEST(LandmarkGraph, AddsNoLandmarkWithoutRoomForItsObservation) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0)));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(graph.try_observe(0, wall_segment(0.0, 1.0)));
  EXPECT_FALSE(graph.try_add_landmark(LandmarkId{1}, wall_segment(0.0, 1.0, 2.0)));
  EXPECT_EQ(graph.landmarks().size(), 1U);
}

TEST(LandmarkGraph, GoesBackToACheckpoint) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  TinyGraph::Checkpoint checkpoint;
  graph.save(checkpoint);
  ASSERT_TRUE(graph.try_observe(0, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{1}, wall_segment(0.0, 1.0, 2.0)));
  graph.poses()[1].T_local_body = Pose2(9.0, 9.0, 1.0);
  graph.landmarks()[0].line_local = {5.0, 0.0};
  graph.restore(checkpoint);
  EXPECT_EQ(graph.poses()[1].T_local_body.x_m(), 0.5);
  ASSERT_EQ(graph.landmarks().size(), 1U);
  EXPECT_EQ(graph.landmarks()[0].line_local.rho_m, 1.0);
  EXPECT_EQ(graph.landmarks()[0].observation_count, 1U);
  EXPECT_EQ(graph.landmarks()[0].last_seen, KeyframeId{0});
  EXPECT_EQ(graph.observations().size(), 1U);
}

TEST(LandmarkGraph, KeepsWhatARetiredPoseKnewOfAWall) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{7}, wall_segment(-1.0, 0.5)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_observe(0, wall_segment(-0.5, 1.0)));
  EXPECT_EQ(graph.marginalize_oldest_pose(), 0U);
  ASSERT_EQ(graph.poses().size(), 1U);
  EXPECT_EQ(graph.poses()[0].id, KeyframeId{1});
  ASSERT_EQ(graph.observations().size(), 1U);
  EXPECT_EQ(graph.observations()[0].pose, 0U);
  const Landmark& wall = graph.landmarks()[0];
  EXPECT_EQ(wall.id, LandmarkId{7});
  EXPECT_EQ(wall.observation_count, 1U);
  EXPECT_NEAR(wall.prior.mean_local.rho_m, 1.0, 1e-9);
  EXPECT_NEAR(wall.prior.information(0, 0), 1e4, 1e-3);
  graph.update_end_points();
  EXPECT_NEAR(std::min(wall.start_local.x_m, wall.end_local.x_m), -1.0, 1e-9);
  EXPECT_NEAR(std::max(wall.start_local.x_m, wall.end_local.x_m), 1.5, 1e-9);
}

TEST(LandmarkGraph, FoldsObservationsIntoThePriorByTheirInformation) {
  TinyGraph graph = graph_of_one_pose();
  LineSegment precise = wall_segment(0.0, 1.0, 1.0);
  LineSegment vague = wall_segment(0.0, 1.0, 1.04);
  vague.covariance *= 3.0;
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, precise));
  ASSERT_TRUE(graph.try_observe(0, vague));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_observe(0, precise));
  graph.marginalize_oldest_pose();
  EXPECT_NEAR(graph.landmarks()[0].prior.mean_local.rho_m, (3.0 * 1.0 + 1.04) / 4.0, 1e-9);
  EXPECT_NEAR(graph.landmarks()[0].prior.information(0, 0), 1e4 * 4.0 / 3.0, 1e-3);
}

TEST(LandmarkGraph, DropsWallsThatNoPoseSeesAnyMore) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0, 2.0)));
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{1}, wall_segment(0.0, 1.0, 1.0)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_observe(1, wall_segment(0.0, 1.0)));
  EXPECT_EQ(graph.marginalize_oldest_pose(), 1U);
  ASSERT_EQ(graph.landmarks().size(), 1U);
  EXPECT_EQ(graph.landmarks()[0].id, LandmarkId{1});
  EXPECT_EQ(graph.observations()[0].landmark, 0U);
}

TEST(LandmarkGraph, SpansAWallOverAllItsObservations) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0)));
  ASSERT_TRUE(graph.try_add_pose(KeyframeId{1}, forward(0.5)));
  ASSERT_TRUE(graph.try_observe(0, wall_segment(1.0, 2.0)));
  graph.update_end_points();
  const Landmark& wall = graph.landmarks()[0];
  EXPECT_NEAR(std::min(wall.start_local.x_m, wall.end_local.x_m), 0.0, 1e-9);
  EXPECT_NEAR(std::max(wall.start_local.x_m, wall.end_local.x_m), 2.5, 1e-9);
}

TEST(LandmarkGraph, HoldsTheDirectionOfANewWall) {
  TinyGraph graph = graph_of_one_pose();
  ASSERT_TRUE(graph.try_add_landmark(LandmarkId{0}, wall_segment(0.0, 1.0)));
  EXPECT_NEAR(graph.chi_square(), 0.0, 1e-12);
  const double off_rad = radians(2);
  graph.add_direction_prior_to_newest(kPi / 2.0 + off_rad, 100.0);
  EXPECT_NEAR(graph.chi_square(), 100.0 * off_rad * off_rad, 1e-9);
}

}  // namespace
}  // namespace swiftlet
