// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/relative_uncertainty.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/geometry/pose_residual.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

RelativePoseFactor<KeyframeId> constraint(std::uint32_t from, std::uint32_t to, const Pose2& T_from_to,
                                          const Eigen::Matrix3d& covariance) {
  return {static_cast<KeyframeId>(from), static_cast<KeyframeId>(to), T_from_to,
          residual_information(T_from_to, covariance)};
}

void add_step(PoseGraph& graph, const Pose2& T_from_to, const Eigen::Matrix3d& covariance) {
  const auto from = static_cast<std::uint32_t>(graph.T_map_keyframe.size() - 1);
  graph.T_map_keyframe.push_back(graph.T_map_keyframe.values().back() * T_from_to);
  graph.factors.push_back(constraint(from, from + 1, T_from_to, covariance));
}

PoseGraph random_chain(std::mt19937& random, int steps) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(random_pose(random, 10.0));
  for (int i = 0; i < steps; ++i)
    add_step(graph, random_pose(random, 1.0), 0.01 * random_covariance(random, 0.1));
  return graph;
}

RelativePoseFactor<KeyframeId> closure(const PoseGraph& graph, std::uint32_t from, std::uint32_t to,
                                       const Eigen::Matrix3d& covariance, double dcs_scale) {
  RelativePoseFactor<KeyframeId> c = constraint(
      from, to,
      between(graph.T_map_keyframe[make_id<KeyframeId>(from)], graph.T_map_keyframe[make_id<KeyframeId>(to)]),
      covariance);
  c.is_closure = true;
  c.dcs_scale = dcs_scale;
  return c;
}

TEST(RelativeCovariances, ComposeAlongAStraightChainAsByHand) {
  const double xx = 0.01;
  const double yy = 0.04;
  const double yaw = 0.001;
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2(2.0, 3.0, 0.7));
  for (int i = 0; i < 3; ++i)
    add_step(graph, Pose2(1.0, 0.0, 0.0), Eigen::Vector3d(xx, yy, yaw).asDiagonal());
  const IdMap<KeyframeId, Eigen::Matrix3d> P = relative_covariances(graph, KeyframeId{0});
  ASSERT_EQ(P.size(), 4U);
  EXPECT_EQ(P[KeyframeId{0}].norm(), 0.0);
  // The first step's heading error moves the end sideways by 2 m times it, the second's by 1 m.
  Eigen::Matrix3d expected;
  expected << 3.0 * xx, 0.0, 0.0,                            //
      0.0, 3.0 * yy + (4.0 + 1.0) * yaw, (2.0 + 1.0) * yaw,  //
      0.0, (2.0 + 1.0) * yaw, 3.0 * yaw;
  EXPECT_LT((P[KeyframeId{3}] - expected).norm(), 1e-12);
}

TEST(RelativeCovariances, OfTheCautiousHaveTheSlipOfEachMotionAndNoHeadings) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  for (int i = 0; i < 3; ++i)
    add_step(graph, Pose2(2.0, 0.0, 0.0), Eigen::Vector3d(0.01, 0.01, 1e-3).asDiagonal());
  for (const KeyframeId known : {KeyframeId{0}, KeyframeId{3}}) graph.headings.push_back({known, 0.0, 1e6});
  const SlipNoise slip{.along_m2_per_m = 0.1, .yaw_rad2_per_m = 0.002};
  const Eigen::Matrix3d P = cautious_relative_covariances(graph, KeyframeId{0}, {}, slip)[KeyframeId{3}];
  EXPECT_NEAR(P(0, 0), 3.0 * (0.01 + 2.0 * 0.1), 1e-9);
  EXPECT_NEAR(P(2, 2), 3.0 * (1e-3 + 2.0 * 0.002), 1e-9);
  EXPECT_LT(relative_covariances(graph, KeyframeId{0})[KeyframeId{3}](2, 2), 1e-5);
}

TEST(RelativeCovariances, TurnWithTheFrameTheyAreSeenFrom) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  add_step(graph, Pose2(0.0, 0.0, kPi / 2.0), Eigen::Vector3d(1e-9, 1e-9, 1e-9).asDiagonal());
  add_step(graph, Pose2(0.0, 0.0, 0.0), Eigen::Vector3d(0.04, 0.01, 1e-9).asDiagonal());
  const IdMap<KeyframeId, Eigen::Matrix3d> P = relative_covariances(graph, KeyframeId{0});
  EXPECT_NEAR(P[KeyframeId{2}](0, 0), 0.01, 1e-6);
  EXPECT_NEAR(P[KeyframeId{2}](1, 1), 0.04, 1e-6);
}

TEST(RelativeCovariances, AreTheSameSeenFromTheOtherEnd) {
  std::mt19937 random(61);
  for (int i = 0; i < 100; ++i) {
    const PoseGraph graph = random_chain(random, 12);
    const Pose2 T_0_12 =
        between(graph.T_map_keyframe[make_id<KeyframeId>(0)], graph.T_map_keyframe[make_id<KeyframeId>(12)]);
    const Eigen::Matrix3d forward = relative_covariances(graph, KeyframeId{0})[KeyframeId{12}];
    const Eigen::Matrix3d backward = relative_covariances(graph, KeyframeId{12})[KeyframeId{0}];
    const Eigen::Matrix3d J = jacobian_inverse(T_0_12);
    ASSERT_LT((backward - J * forward * J.transpose()).norm(), 1e-9 * backward.norm());
  }
}

TEST(RelativeCovariances, AClosureShortensTheWay) {
  std::mt19937 random(62);
  PoseGraph graph = random_chain(random, 30);
  const IdMap<KeyframeId, Eigen::Matrix3d> open = relative_covariances(graph, KeyframeId{0});
  const Eigen::Matrix3d tight = 1e-5 * Eigen::Matrix3d::Identity();
  graph.factors.push_back(closure(graph, 0, 30, tight, 1.0));
  const IdMap<KeyframeId, Eigen::Matrix3d> closed = relative_covariances(graph, KeyframeId{0});
  EXPECT_LT((closed[KeyframeId{30}] - tight).norm(), 1e-12) << "the closure alone";
  EXPECT_LT(closed[KeyframeId{29}].trace(), 0.5 * open[KeyframeId{29}].trace()) << "back along the last step";
  EXPECT_LT((closed[KeyframeId{3}] - open[KeyframeId{3}]).norm(), 1e-12)
      << "near the start the chain is shorter";
}

TEST(RelativeCovariances, AClosureServesInBothDirections) {
  std::mt19937 random(63);
  PoseGraph graph = random_chain(random, 30);
  const Eigen::Matrix3d covariance = 1e-5 * random_covariance(random, 0.1);
  graph.factors.push_back(closure(graph, 30, 0, covariance, 1.0));
  const Eigen::Matrix3d J = jacobian_inverse(
      between(graph.T_map_keyframe[make_id<KeyframeId>(30)], graph.T_map_keyframe[make_id<KeyframeId>(0)]));
  const Eigen::Matrix3d P = relative_covariances(graph, KeyframeId{0})[KeyframeId{30}];
  EXPECT_LT((P - J * covariance * J.transpose()).norm(), 1e-9 * P.norm());
}

TEST(RelativeCovariances, DisbelievedClosuresTellNothing) {
  std::mt19937 random(64);
  PoseGraph graph = random_chain(random, 30);
  const IdMap<KeyframeId, Eigen::Matrix3d> open = relative_covariances(graph, KeyframeId{0});
  graph.factors.push_back(closure(graph, 0, 30, 1e-5 * Eigen::Matrix3d::Identity(), 0.1));
  const IdMap<KeyframeId, Eigen::Matrix3d> still_open = relative_covariances(graph, KeyframeId{0});
  for (std::size_t k = 0; k < open.size(); ++k) EXPECT_EQ(still_open.values()[k], open.values()[k]);
}

TEST(RelativeCovariances, WhatNothingConnectsIsUnknown) {
  std::mt19937 random(65);
  PoseGraph graph = random_chain(random, 3);
  graph.T_map_keyframe.push_back(Pose2(1.0, 1.0, 0.0));
  EXPECT_GT(relative_covariances(graph, KeyframeId{0})[KeyframeId{4}].diagonal().minCoeff(), 1e5);
}

TEST(RelativeCovariances, AHeadingBoundsTheHeadingAndWhatItDoesToThePosition) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  for (int i = 0; i < 200; ++i)
    add_step(graph, Pose2(0.5, 0.0, 0.0), Eigen::Vector3d(1e-4, 1e-4, 4e-4).asDiagonal());
  const Eigen::Matrix3d without = relative_covariances(graph, KeyframeId{0})[KeyframeId{200}];
  const double variance_rad2 = 1e-3;
  for (std::uint32_t k = 0; k <= 200; k += 6)
    graph.headings.push_back({.pose = KeyframeId{k}, .information = 1.0 / variance_rad2});
  const Eigen::Matrix3d with = relative_covariances(graph, KeyframeId{0})[KeyframeId{200}];
  EXPECT_LT(with(2, 2), 4.0 * variance_rad2);
  EXPECT_GT(without(2, 2), 0.07);
  EXPECT_LT(std::sqrt(with(1, 1)), 0.25 * std::sqrt(without(1, 1)));
  EXPECT_NEAR(with(0, 0), without(0, 0), 1e-12) << "along the way a heading tells nothing";
}

TEST(RelativeCovariances, AHeadingTellsNothingOfThoseWithoutOne) {
  std::mt19937 random(66);
  PoseGraph graph = random_chain(random, 30);
  const IdMap<KeyframeId, Eigen::Matrix3d> without = relative_covariances(graph, KeyframeId{0});
  graph.headings.push_back({.pose = KeyframeId{20}, .information = 1e6});
  const IdMap<KeyframeId, Eigen::Matrix3d> with = relative_covariances(graph, KeyframeId{0});
  for (std::size_t k = 0; k < with.size(); ++k) EXPECT_EQ(with.values()[k], without.values()[k]);
}

TEST(RelativeCovariances, HeadingsTellNoMoreThanTheWayToTheFirstOfThem) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  for (int i = 0; i < 2; ++i)
    add_step(graph, Pose2(0.5, 0.0, 0.0), Eigen::Vector3d(1e-4, 1e-4, 1e-3).asDiagonal());
  for (const KeyframeId known : {KeyframeId{1}, KeyframeId{2}}) graph.headings.push_back({known, 0.0, 1e9});
  EXPECT_GT(relative_covariances(graph, KeyframeId{0})[KeyframeId{2}](2, 2), 0.5e-3);
}

TEST(RelativeCovariances, DisbelievedHeadingsTellNothing) {
  std::mt19937 random(66);
  PoseGraph graph = random_chain(random, 30);
  const IdMap<KeyframeId, Eigen::Matrix3d> without = relative_covariances(graph, KeyframeId{0});
  graph.headings.push_back({.pose = KeyframeId{20}, .information = 1e6, .dcs_scale = 0.1});
  const IdMap<KeyframeId, Eigen::Matrix3d> with = relative_covariances(graph, KeyframeId{0});
  for (std::size_t k = 0; k < with.size(); ++k) EXPECT_EQ(with.values()[k], without.values()[k]);
}

}  // namespace
}  // namespace swiftlet
