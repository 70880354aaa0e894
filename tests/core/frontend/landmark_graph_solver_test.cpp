// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_graph_solver.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr LandmarkGraphCapacity kCapacity{16, 8, 64};
using Graph = LandmarkGraph<kCapacity>;
using Solver = LandmarkGraphSolver<kCapacity>;

constexpr std::size_t kPoses = 10;

// A drive of ten keyframes past four walls; every pose sees two or three of them.
class LandmarkGraphSolverTest : public testing::Test {
 protected:
  void build(double noise_scale, unsigned seed) {
    test::RandomGeometry random(seed);
    const std::vector<Line2> walls{{2.0, kPi / 2.0}, {2.5, -kPi / 2.0}, {7.0, 0.2}, {1.5, 2.8}};
    graph_ = std::make_unique<Graph>();
    std::vector<std::optional<std::size_t>> slot(walls.size());
    Pose2 T_local_body;
    for (std::size_t k = 0; k < kPoses; ++k) {
      if (k == 0) {
        graph_->add_first_pose(KeyframeId{0}, Pose2());
      } else {
        const Pose2 step(0.5, 0.0, 0.15);
        T_local_body = T_local_body * step;
        UncertainMotion motion = uncertain_step(OdometryNoise(), step, std::chrono::milliseconds(100));
        motion.covariance *= 4.0;
        motion.T_from_to = test::pose_of(step.vector() + noise_scale * Eigen::Vector3d(random.normal(0.03),
                                                                                       random.normal(0.03),
                                                                                       random.normal(0.03)));
        ASSERT_TRUE(graph_->try_add_pose(KeyframeId{static_cast<std::uint32_t>(k)}, motion));
      }
      truth_.push_back(T_local_body);
      for (std::size_t w = 0; w < walls.size(); ++w) {
        if ((k + w) % 3 == 0) continue;
        LineSegment segment;
        segment.line = transform_line(T_local_body.inverse(), walls[w]).line_b;
        segment.line.rho_m += noise_scale * random.normal(0.01);
        segment.line.alpha_rad = wrap_angle(segment.line.alpha_rad + noise_scale * random.normal(0.01));
        segment.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
        if (slot[w]) {
          ASSERT_TRUE(graph_->try_observe(*slot[w], segment));
        } else {
          slot[w] = graph_->landmarks().size();
          ASSERT_TRUE(graph_->try_add_landmark(LandmarkId{static_cast<std::uint32_t>(w)}, segment));
        }
      }
    }
  }
  // Derivative of F by central differences with respect to one number of the estimate.
  double slope(const std::function<void(double)>& move_by) {
    constexpr double kStep = 1e-6;
    move_by(kStep);
    const double above = graph_->chi_square();
    move_by(-2.0 * kStep);
    const double below = graph_->chi_square();
    move_by(kStep);
    return (above - below) / (2.0 * kStep);
  }
  double steepest_slope() {
    double steepest = 0.0;
    for (std::size_t i = 1; i < graph_->poses().size(); ++i)
      for (int k = 0; k < 3; ++k)
        steepest = std::max(steepest, std::abs(slope([&](double by) {
                              Eigen::Vector3d v = graph_->poses()[i].T_local_body.vector();
                              v(k) += by;
                              graph_->poses()[i].T_local_body = test::pose_of(v);
                            })));
    for (Landmark& landmark : graph_->landmarks()) {
      steepest = std::max(steepest, std::abs(slope([&](double by) { landmark.line_local.rho_m += by; })));
      steepest = std::max(steepest, std::abs(slope([&](double by) { landmark.line_local.alpha_rad += by; })));
    }
    return steepest;
  }
  void disturb(unsigned seed) {
    test::RandomGeometry random(seed);
    for (std::size_t i = 1; i < graph_->poses().size(); ++i)
      graph_->poses()[i].T_local_body = graph_->poses()[i].T_local_body *
                                        Pose2(random.normal(0.1), random.normal(0.1), random.normal(0.05));
  }

  std::unique_ptr<Graph> graph_;
  std::unique_ptr<Solver> solver_ = std::make_unique<Solver>();
  std::vector<Pose2> truth_;
};

TEST_F(LandmarkGraphSolverTest, FindsTheTruthWhenNothingIsNoisy) {
  build(0.0, 1);
  disturb(2);
  const Solver::Summary summary = solver_->optimize(*graph_, 30);
  EXPECT_NEAR(summary.chi_square, 0.0, 1e-4);
  for (std::size_t i = 0; i < kPoses; ++i) {
    const Pose2 error = between(truth_[i], graph_->poses()[i].T_local_body);
    EXPECT_NEAR(error.x_m(), 0.0, 1e-4);
    EXPECT_NEAR(error.y_m(), 0.0, 1e-4);
    EXPECT_NEAR(error.yaw_rad(), 0.0, 1e-4);
  }
}

TEST_F(LandmarkGraphSolverTest, EndsWhereFHasNoSlope) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    build(1.0, seed);
    const double slope_before = steepest_slope();
    solver_->optimize(*graph_, 50);
    solver_->optimize(*graph_, 50);  // the first may have settled early
    EXPECT_LT(steepest_slope(), 1e-4 * slope_before);
  }
}

TEST_F(LandmarkGraphSolverTest, MindsThePriorsOfRetiredPoses) {
  build(1.0, 3);
  solver_->optimize(*graph_, 50);
  for (int i = 0; i < 4; ++i) graph_->marginalize_oldest_pose();
  disturb(4);
  const double slope_before = steepest_slope();
  solver_->optimize(*graph_, 50);
  solver_->optimize(*graph_, 50);
  EXPECT_LT(steepest_slope(), 1e-4 * slope_before);
}

TEST_F(LandmarkGraphSolverTest, LeavesTheOldestPoseWhereItIs) {
  build(1.0, 5);
  solver_->optimize(*graph_, 20);
  EXPECT_EQ(graph_->poses()[0].T_local_body.vector(), Eigen::Vector3d::Zero());
}

TEST_F(LandmarkGraphSolverTest, MakesTheTrajectoryBetterThanDeadReckoning) {
  double before = 0.0;
  double after = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    truth_.clear();
    build(1.0, seed);
    const auto error_m = [&] {
      const Pose2 error = between(truth_.back(), graph_->poses().back().T_local_body);
      return std::hypot(error.x_m(), error.y_m());
    };
    before += error_m();
    solver_->optimize(*graph_, 20);
    after += error_m();
  }
  EXPECT_LT(after, 0.5 * before);
}

TEST_F(LandmarkGraphSolverTest, NeverMakesFWorse) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    build(1.0, seed);
    test::RandomGeometry random(seed);
    for (std::size_t i = 1; i < graph_->poses().size(); ++i) graph_->poses()[i].T_local_body = random.pose();
    double last = graph_->chi_square();
    for (int step = 0; step < 20; ++step) {
      const double now = solver_->optimize(*graph_, 1).chi_square;
      EXPECT_LE(now, last);
      EXPECT_NEAR(now, graph_->chi_square(), 1e-9 * (1.0 + now));
      last = now;
    }
  }
}

TEST_F(LandmarkGraphSolverTest, HasNothingToDoWithASinglePose) {
  graph_ = std::make_unique<Graph>();
  graph_->add_first_pose(KeyframeId{0}, Pose2());
  EXPECT_EQ(solver_->optimize(*graph_, 10).steps, 0);
}

}  // namespace
}  // namespace swiftlet
