// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "core/geometry/pose_residual.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr double kPhi = 5.0;
constexpr int kEnough = 50;
constexpr double kSigmaM = 0.02;
constexpr double kSigmaRad = 0.01;
constexpr std::uint32_t kLap = 40;  // steps once around the square

KeyframeId keyframe(std::size_t i) { return static_cast<KeyframeId>(i); }

/// 0.5 m ahead, a quarter turn at each corner of a square of 5 m.
Pose2 true_step(std::uint32_t i) { return {0.5, 0.0, i % 10 == 9 ? kPi / 2.0 : 0.0}; }

std::vector<Pose2> true_poses(std::uint32_t count) {
  std::vector<Pose2> T_map_keyframe{Pose2(1.0, -2.0, 0.3)};
  for (std::uint32_t i = 0; i + 1 < count; ++i)
    T_map_keyframe.push_back(T_map_keyframe.back() * true_step(i));
  return T_map_keyframe;
}

Pose2 disturbed(const Pose2& T_a_b, std::mt19937& random, double sigma_m, double sigma_rad) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const double x_m = sigma_m * noise(random);
  const double y_m = sigma_m * noise(random);
  return T_a_b * Pose2(x_m, y_m, sigma_rad * noise(random));
}

Eigen::Matrix3d information(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(1.0 / (sigma_m * sigma_m), 1.0 / (sigma_m * sigma_m), 1.0 / (sigma_rad * sigma_rad))
      .asDiagonal();
}

RelativePoseFactor<KeyframeId> closure(std::size_t from, std::size_t to, const Pose2& T_from_to) {
  return {keyframe(from), keyframe(to), T_from_to, information(kSigmaM, kSigmaRad), true};
}

/// Laps around the square as dead reckoning has them: steps with noise and poses that follow them.
PoseGraph dead_reckoning(std::mt19937& random, std::uint32_t count, double noise) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(true_poses(1)[0]);
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const Pose2 step = disturbed(true_step(i), random, noise * kSigmaM, noise * kSigmaRad);
    graph.factors.push_back({keyframe(i), keyframe(i + 1), step, information(kSigmaM, kSigmaRad)});
    graph.T_map_keyframe.push_back(graph.T_map_keyframe.values().back() * step);
  }
  return graph;
}

/// Every fourth keyframe of the second lap is matched with its place in the first.
void close_second_lap(PoseGraph& graph, std::mt19937& random, double noise) {
  const std::vector<Pose2> truth = true_poses(static_cast<std::uint32_t>(graph.T_map_keyframe.size()));
  for (std::size_t to = kLap; to < truth.size(); to += 4) {
    const Pose2 T_from_to = between(truth[to - kLap], truth[to]);
    graph.factors.push_back(
        closure(to - kLap, to, disturbed(T_from_to, random, noise * kSigmaM, noise * kSigmaRad)));
  }
}

double rms_error_m(const PoseGraph& graph) {
  const std::vector<Pose2> truth = true_poses(static_cast<std::uint32_t>(graph.T_map_keyframe.size()));
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose2 error = between(truth[i], graph.T_map_keyframe[keyframe(i)]);
    sum += error.x_m() * error.x_m() + error.y_m() * error.y_m();
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

void optimize(PoseGraph& graph) {
  const Result<OptimizeReport> report = PoseGraphOptimizer(kPhi, kEnough).optimize(graph);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->converged);
  EXPECT_LT(report->iterations, kEnough);
}

void expect_same_poses(const PoseGraph& a, const PoseGraph& b, double tolerance) {
  ASSERT_EQ(a.T_map_keyframe.size(), b.T_map_keyframe.size());
  for (std::size_t i = 0; i < a.T_map_keyframe.size(); ++i)
    EXPECT_TRUE(
        poses_near(a.T_map_keyframe[keyframe(i)], b.T_map_keyframe[keyframe(i)], tolerance, tolerance))
        << i;
}

/// The slow twin: one Gauss-Newton step on dense matrices over all poses, the first one's rows taken out.
double dense_step(PoseGraph& graph) {
  const auto n = static_cast<Eigen::Index>(3 * graph.T_map_keyframe.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for (RelativePoseFactor<KeyframeId>& c : graph.factors.values()) {
    const PoseResidual r =
        pose_residual(c.T_from_to, graph.T_map_keyframe[c.from], graph.T_map_keyframe[c.to]);
    if (c.is_closure) c.dcs_scale = dcs_scale(r.error.dot(c.information * r.error), kPhi);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n);
    J.middleCols<3>(3 * static_cast<Eigen::Index>(index_of(c.from))) = r.J_from;
    J.middleCols<3>(3 * static_cast<Eigen::Index>(index_of(c.to))) = r.J_to;
    const Eigen::Matrix3d W = c.dcs_scale * c.dcs_scale * c.information;
    H += J.transpose() * W * J;
    b -= J.transpose() * W * r.error;
  }
  const Eigen::VectorXd step = H.bottomRightCorner(n - 3, n - 3).ldlt().solve(b.tail(n - 3));
  for (std::size_t i = 1; i < graph.T_map_keyframe.size(); ++i) {
    const Eigen::Vector3d moved =
        graph.T_map_keyframe[keyframe(i)].vector() + step.segment<3>(3 * static_cast<Eigen::Index>(i - 1));
    graph.T_map_keyframe[keyframe(i)] = Pose2(moved[0], moved[1], moved[2]);
  }
  return step.cwiseAbs().maxCoeff();
}

TEST(PoseGraphOptimizer, RestoresTheTruthFromExactMeasurements) {
  std::mt19937 random(71);
  PoseGraph graph = dead_reckoning(random, 2 * kLap, 0.0);
  close_second_lap(graph, random, 0.0);
  for (std::size_t i = 1; i < graph.T_map_keyframe.size(); ++i)
    graph.T_map_keyframe[keyframe(i)] = disturbed(graph.T_map_keyframe[keyframe(i)], random, 0.3, 0.1);
  // Fully believed, as motion is: this is about Gauss-Newton alone.
  for (RelativePoseFactor<KeyframeId>& c : graph.factors.values()) c.is_closure = false;
  optimize(graph);
  EXPECT_LT(rms_error_m(graph), 1e-6);
}

TEST(PoseGraphOptimizer, LoopsBringThePathNearerToTheTruth) {
  double before_m = 0.0;
  double after_m = 0.0;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    PoseGraph graph = dead_reckoning(random, 3 * kLap, 1.0);
    close_second_lap(graph, random, 1.0);
    before_m += rms_error_m(graph);
    optimize(graph);
    after_m += rms_error_m(graph);
  }
  EXPECT_LT(after_m, 0.6 * before_m);
}

TEST(PoseGraphOptimizer, EqualsADenseGaussNewtonStepByStep) {
  for (int iterations = 1; iterations <= 4; ++iterations) {
    std::mt19937 random(72);
    PoseGraph graph = dead_reckoning(random, 60, 2.0);
    close_second_lap(graph, random, 1.0);
    graph.factors.push_back(closure(5, 30, Pose2(0.2, 0.1, 0.0)));
    graph.factors.push_back(closure(50, 10, Pose2(0.03, -0.02, 0.01)));  // from late to early
    PoseGraph twin = graph;
    const Result<OptimizeReport> report = PoseGraphOptimizer(kPhi, iterations).optimize(graph);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->converged);
    for (int i = 0; i < iterations; ++i) ASSERT_GT(dense_step(twin), 1e-5) << "no early end";
    expect_same_poses(graph, twin, 1e-8);
    dense_step(twin);  // writes the scales at the poses it starts from
    for (std::size_t i = 0; i < graph.factors.size(); ++i)
      EXPECT_NEAR(graph.factors.values()[i].dcs_scale, twin.factors.values()[i].dcs_scale, 1e-8);
  }
}

TEST(PoseGraphOptimizer, TheFirstPoseStaysWhereItIs) {
  std::mt19937 random(73);
  PoseGraph graph = dead_reckoning(random, 2 * kLap, 1.0);
  close_second_lap(graph, random, 1.0);
  const Eigen::Vector3d first = graph.T_map_keyframe[keyframe(0)].vector();
  optimize(graph);
  EXPECT_EQ(graph.T_map_keyframe[keyframe(0)].vector(), first);
}

TEST(PoseGraphOptimizer, FalseClosuresAreScaledDownAndGoodOnesStay) {
  std::mt19937 random(74);
  PoseGraph graph = dead_reckoning(random, 2 * kLap, 0.5);
  close_second_lap(graph, random, 1.0);
  PoseGraph without = graph;
  const std::size_t first_false = graph.factors.size();
  graph.factors.push_back(closure(0, 20, Pose2(0.1, -0.2, 0.0)));
  graph.factors.push_back(closure(10, 70, Pose2(0.5, 0.0, 1.5)));
  optimize(graph);
  optimize(without);
  for (std::size_t i = 0; i < graph.factors.size(); ++i) {
    const RelativePoseFactor<KeyframeId>& c = graph.factors.values()[i];
    if (!c.is_closure) {
      EXPECT_EQ(c.dcs_scale, 1.0) << "motion is never scaled";
    } else if (i < first_false) {
      EXPECT_GT(c.dcs_scale, 0.5) << "true closure to " << index_of(c.to);
    } else {
      EXPECT_LT(c.dcs_scale, 0.01) << "false closure to " << index_of(c.to);
    }
  }
  expect_same_poses(graph, without, 0.02);
}

TEST(PoseGraphOptimizer, AClosureMeansTheSameFromEitherEnd) {
  std::mt19937 random(75);
  PoseGraph forward = dead_reckoning(random, kLap + 5, 1.0);
  PoseGraph backward = forward;
  const Pose2 T_4_end(0.05, 0.02, 0.01);
  forward.factors.push_back(closure(4, kLap + 4, T_4_end));
  backward.factors.push_back(closure(kLap + 4, 4, T_4_end.inverse()));
  // The same knowledge, in the frame of the other end.
  const Eigen::Matrix3d J = jacobian_inverse(T_4_end.inverse());
  const Eigen::Matrix3d R = jacobian_compose_second(T_4_end);
  const Eigen::Matrix3d to_forward_error = R.transpose() * J;
  backward.factors.values().back().information =
      to_forward_error.transpose() * forward.factors.values().back().information * to_forward_error;
  optimize(forward);
  optimize(backward);
  expect_same_poses(forward, backward, 2e-3);
}

TEST(PoseGraphOptimizer, KeptAnalysisGivesTheSameBytesAsAFreshOne) {
  std::mt19937 random(76);
  PoseGraphOptimizer kept(kPhi, kEnough);
  PoseGraph graph = dead_reckoning(random, 2 * kLap, 1.0);
  close_second_lap(graph, random, 1.0);
  for (int round = 0; round < 3; ++round) {
    // The same pairs measured anew; in the last round another closure changes the pattern.
    for (RelativePoseFactor<KeyframeId>& c : graph.factors.values())
      c.T_from_to = disturbed(c.T_from_to, random, 0.01, 0.005);
    if (round == 2) graph.factors.push_back(closure(3, 45, Pose2(2.5, 0.0, 0.0)));
    PoseGraph twin = graph;
    ASSERT_TRUE(kept.optimize(graph));
    ASSERT_TRUE(PoseGraphOptimizer(kPhi, kEnough).optimize(twin));
    expect_same_poses(graph, twin, 0.0);
  }
}

TEST(PoseGraphOptimizer, NothingToMoveIsNoError) {
  PoseGraph graph;
  PoseGraphOptimizer optimizer(kPhi, kEnough);
  ASSERT_TRUE(optimizer.optimize(graph));
  graph.T_map_keyframe.push_back(Pose2(1.0, 2.0, 3.0));
  const Result<OptimizeReport> report = optimizer.optimize(graph);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->iterations, 0);
}

TEST(PoseGraphOptimizer, ReportsTheChiSquareOfWhatIsLeft) {
  // Two measurements of one step, 0.04 m apart: the middle leaves 0.02 m, one sigma, to each.
  PoseGraph graph;
  graph.T_map_keyframe = KeyframePoses(std::vector<Pose2>(2));
  for (const double x_m : {1.0, 1.04})
    graph.factors.push_back(
        {keyframe(0), keyframe(1), Pose2(x_m, 0.0, 0.0), information(kSigmaM, kSigmaRad)});
  const Result<OptimizeReport> report = PoseGraphOptimizer(kPhi, kEnough).optimize(graph);
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->chi_square, 2.0, 1e-9);
  EXPECT_NEAR(graph.T_map_keyframe[keyframe(1)].x_m(), 1.02, 1e-12);
}

TEST(PoseGraphOptimizer, ALoosePoseIsASolverErrorAndMovesNothing) {
  std::mt19937 random(77);
  PoseGraph graph = dead_reckoning(random, 10, 1.0);
  graph.T_map_keyframe.push_back(random_pose(random, 5.0));
  graph.T_map_keyframe[keyframe(4)] = random_pose(random, 5.0);
  const PoseGraph before = graph;
  const Result<OptimizeReport> report = PoseGraphOptimizer(kPhi, kEnough).optimize(graph);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kSolver);
  expect_same_poses(graph, before, 0.0);
}

TEST(PoseGraphOptimizer, OnASolverErrorTheClosuresScalesAreAsTheyWere) {
  PoseGraph graph;
  graph.T_map_keyframe = KeyframePoses({Pose2(), Pose2(1.0, 0.0, 0.0), Pose2(5.0, 5.0, 0.0)});
  graph.factors.push_back({KeyframeId{0}, KeyframeId{1}, Pose2(1.0, 0.0, 0.0)});
  graph.factors.push_back(
      {KeyframeId{0}, KeyframeId{1}, Pose2(9.0, 9.0, 0.0), Eigen::Matrix3d::Identity(), true});
  ASSERT_FALSE(PoseGraphOptimizer(5.0, 20).optimize(graph));
  EXPECT_EQ(graph.factors.values()[1].dcs_scale, 1.0);
}

TEST(PoseGraphOptimizer, NamesTheKeyframeThatNothingHolds) {
  PoseGraph graph;
  graph.T_map_keyframe =
      KeyframePoses({Pose2(), Pose2(1.0, 0.0, 0.0), Pose2(5.0, 5.0, 0.0), Pose2(2.0, 0.0, 0.0)});
  graph.factors.push_back({KeyframeId{0}, KeyframeId{1}, Pose2(1.0, 0.0, 0.0)});
  graph.factors.push_back({KeyframeId{1}, KeyframeId{3}, Pose2(1.0, 0.0, 0.0)});
  const Result<OptimizeReport> report = PoseGraphOptimizer(5.0, 20).optimize(graph);
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, testing::HasSubstr("near pose 2:"));
}

TEST(PoseGraphOptimizer, AWorseContradictionLeavesAGreaterChiSquare) {
  const auto objective = [](double false_x_m) {
    PoseGraph graph;
    graph.T_map_keyframe = KeyframePoses({Pose2(), Pose2(1.0, 0.0, 0.0)});
    graph.factors.push_back(
        {KeyframeId{0}, KeyframeId{1}, Pose2(1.0, 0.0, 0.0), 1e6 * Eigen::Matrix3d::Identity()});
    graph.factors.push_back(
        {KeyframeId{0}, KeyframeId{1}, Pose2(false_x_m, 0.0, 0.0), Eigen::Matrix3d::Identity(), true});
    return PoseGraphOptimizer(5.0, 20).optimize(graph)->chi_square;
  };
  EXPECT_GT(objective(20.0), 1.2 * objective(4.0));
}

TEST(PoseGraphOptimizer, ReportsTheChiSquareAfterItsLastStep) {
  PoseGraph graph;
  graph.T_map_keyframe = KeyframePoses({Pose2(), Pose2(3.0, 0.0, 0.0)});
  graph.factors.push_back({KeyframeId{0}, KeyframeId{1}, Pose2(1.0, 0.0, 0.0)});
  const Result<OptimizeReport> report = PoseGraphOptimizer(5.0, 1).optimize(graph);
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->chi_square, 0.0, 1e-9);
}

TEST(PoseGraphOptimizer, HeadingsTurnTheWayTheyAreTold) {
  std::mt19937 random(71);
  PoseGraph graph = dead_reckoning(random, 2 * kLap, 3.0);
  const std::vector<Pose2> truth = true_poses(2 * kLap);
  for (std::size_t k = 5; k < truth.size(); k += 5)
    graph.headings.push_back(
        {.pose = keyframe(k), .yaw_map_rad = truth[k].yaw_rad() + 2.0 * kPi, .information = 1e6});
  ASSERT_TRUE(PoseGraphOptimizer(1e9, kEnough).optimize(graph));
  for (const HeadingFactor<KeyframeId>& c : graph.headings) {
    EXPECT_NEAR(wrap_angle(graph.T_map_keyframe[c.pose].yaw_rad() - c.yaw_map_rad), 0.0, 2e-3);
    EXPECT_EQ(c.dcs_scale, 1.0);
  }
}

TEST(PoseGraphOptimizer, AFalseHeadingIsScaledAway) {
  std::mt19937 random(72);
  PoseGraph graph = dead_reckoning(random, kLap, 0.1);
  const std::vector<Pose2> truth = true_poses(kLap);
  for (std::size_t k = 3; k < truth.size(); k += 3)
    graph.headings.push_back({.pose = keyframe(k), .yaw_map_rad = truth[k].yaw_rad(), .information = 1e3});
  graph.headings[6].yaw_map_rad += 0.5;
  ASSERT_TRUE(PoseGraphOptimizer(kPhi, kEnough).optimize(graph));
  EXPECT_LT(graph.headings[6].dcs_scale, 0.1);
  EXPECT_GT(graph.headings[5].dcs_scale, 0.9);
  EXPECT_LT(rms_error_m(graph), 0.05);
}

}  // namespace
}  // namespace swiftlet
