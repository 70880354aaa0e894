// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

FlowOdometryModel perfect() {
  FlowOdometryModel model;
  model.scale_spread = 0.0;
  model.scale_wander = 0.0;
  model.velocity_noise_m_s = 0.0;
  model.yaw_bias_min_rad_s = 0.0;
  model.yaw_bias_max_rad_s = 0.0;
  model.yaw_walk_rad_sqrt_s = 0.0;
  model.turn_scale_spread = 0.0;
  model.slips_per_s = 0.0;
  return model;
}

/// Straight ahead at 0.5 m/s.
std::vector<FlightState> straight_flight(double duration_s) {
  FlightState cruising;
  cruising.vx_body_m_s = 0.5;
  cruising.height_m = 0.5;
  return std::vector<FlightState>(static_cast<std::size_t>(duration_s * 100.0), cruising);
}

Pose2 estimate_after(const std::vector<FlightState>& flight, const FlowOdometryModel& model,
                     std::uint64_t seed) {
  FlowOdometry odometry(model, seed);
  for (const FlightState& state : flight) odometry.step(state);
  return odometry.T_odom_body();
}

double sigma_over_seeds(const std::vector<FlightState>& flight, const FlowOdometryModel& model) {
  double squares = 0.0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    squares += std::pow(estimate_after(flight, model, seed).yaw_rad(), 2);
  return std::sqrt(squares / kSeeds);
}

/// What remains of the position error after the best rigid alignment, and the spread of the heading error.
struct Drift {
  double position_rms_m = 0.0;
  double heading_range_rad = 0.0;
};
Drift drift_of(const std::string& world, std::uint64_t seed) {
  const std::vector<FlightState> flight = fly(make_simulated_world(world).value(), PilotModel{}, seed);
  FlowOdometry odometry({}, seed);
  std::vector<Pose2> truth;
  std::vector<Pose2> estimate;
  double heading_error = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  for (std::size_t i = 1; i < flight.size(); ++i) {
    odometry.step(flight[i]);
    truth.push_back(between(flight[0].T_world_body, flight[i].T_world_body));
    estimate.push_back(odometry.T_odom_body());
    heading_error += wrap_angle(estimate.back().yaw_rad() - truth.back().yaw_rad() - heading_error);
    lowest = std::min(lowest, heading_error);
    highest = std::max(highest, heading_error);
  }
  Eigen::Vector2d mean_truth = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_estimate = Eigen::Vector2d::Zero();
  const auto count = static_cast<double>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    mean_truth += truth[i].vector().head<2>() / count;
    mean_estimate += estimate[i].vector().head<2>() / count;
  }
  double dot = 0.0;
  double cross = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector2d t = truth[i].vector().head<2>() - mean_truth;
    const Eigen::Vector2d e = estimate[i].vector().head<2>() - mean_estimate;
    dot += e.dot(t);
    cross += e.x() * t.y() - e.y() * t.x();
    squares += e.squaredNorm() + t.squaredNorm();
  }
  return {std::sqrt((squares - 2.0 * std::hypot(dot, cross)) / count), highest - lowest};
}

TEST(FlowOdometry, FollowsTheTruthWithoutErrors) {
  const std::vector<FlightState> flight = fly(make_simulated_world("office").value(), PilotModel{}, 1);
  FlowOdometry odometry(perfect(), 1);
  for (std::size_t i = 1; i < flight.size(); ++i) odometry.step(flight[i]);
  const Pose2 truth = between(flight.front().T_world_body, flight.back().T_world_body);
  EXPECT_NEAR(odometry.T_odom_body().x_m(), truth.x_m(), 0.05);
  EXPECT_NEAR(odometry.T_odom_body().y_m(), truth.y_m(), 0.05);
  EXPECT_NEAR(odometry.T_odom_body().yaw_rad(), truth.yaw_rad(), 1e-6);
}

TEST(FlowOdometry, ScalesItsMeasurements) {
  FlowOdometryModel model = perfect();
  model.scale_spread = 0.1;
  const double x_m = estimate_after(straight_flight(20.0), model, 1).x_m();
  EXPECT_GT(std::abs(x_m - 10.0), 0.01);
  EXPECT_LE(std::abs(x_m - 10.0), 1.0);
  EXPECT_NE(x_m, estimate_after(straight_flight(20.0), model, 2).x_m());
}

TEST(FlowOdometry, DriftsInHeadingByItsBias) {
  FlowOdometryModel model = perfect();
  model.yaw_bias_min_rad_s = model.yaw_bias_max_rad_s = radians(2.0) / 60.0;
  int to_the_left = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double yaw_rad = estimate_after(straight_flight(60.0), model, seed).yaw_rad();
    EXPECT_NEAR(std::abs(yaw_rad), radians(2.0), 1e-6);
    to_the_left += yaw_rad > 0.0 ? 1 : 0;
  }
  EXPECT_GT(to_the_left, 2);
  EXPECT_LT(to_the_left, 18);
}

TEST(FlowOdometry, WalksInHeadingWithTheRootOfTime) {
  FlowOdometryModel model = perfect();
  model.yaw_walk_rad_sqrt_s = radians(0.6);
  EXPECT_NEAR(sigma_over_seeds(straight_flight(4.0), model), radians(1.2), radians(0.15));
  EXPECT_NEAR(sigma_over_seeds(straight_flight(16.0), model), radians(2.4), radians(0.3));
}

TEST(FlowOdometry, MeasuresAShareOfTheMotionOnAFloorPatch) {
  FlowOdometryModel model = perfect();
  model.floor_patches = {{{1.0, 0.0}, 0.5, 0.6}};
  const std::vector<FlightState> flight = fly({{}, {{{0.0, 0.0}}, {{3.0, 0.0}}}}, PilotModel{}, 1);
  const double missed_m = estimate_after(flight, perfect(), 1).x_m() - estimate_after(flight, model, 1).x_m();
  EXPECT_NEAR(missed_m, 0.4, 0.05);
}

TEST(FlowOdometry, JumpsInHeadingAsOftenAndAsFarAsTheModelSays) {
  FlowOdometryModel model = perfect();
  model.yaw_jumps_per_s = 1.0 / 20.0;
  model.yaw_jump_min_rad = model.yaw_jump_max_rad = radians(5.0);
  FlowOdometry odometry(model, 1);
  int jumps = 0;
  int to_the_left = 0;
  double before_rad = 0.0;
  for (const FlightState& state : straight_flight(8000.0)) {
    odometry.step(state);
    const double turned_rad = wrap_angle(odometry.T_odom_body().yaw_rad() - before_rad);
    before_rad = odometry.T_odom_body().yaw_rad();
    if (std::abs(turned_rad) < 1e-9) continue;
    ++jumps;
    to_the_left += turned_rad > 0.0 ? 1 : 0;
    EXPECT_NEAR(std::abs(turned_rad), radians(5.0), 1e-9);
  }
  EXPECT_NEAR(jumps, 400, 60) << "three standard deviations";
  EXPECT_NEAR(to_the_left, 200, 42) << "three standard deviations";
}

TEST(FlowOdometry, ReportsReverseMotionAsForwardWhereItLosesTheSign) {
  FlowOdometryModel model = perfect();
  model.loses_reverse_sign = true;
  std::vector<FlightState> flight = straight_flight(10.0);
  for (std::size_t i = flight.size() / 2; i < flight.size(); ++i) flight[i].vx_body_m_s = -0.5;
  EXPECT_NEAR(estimate_after(flight, perfect(), 1).x_m(), 0.0, 1e-9);
  EXPECT_NEAR(estimate_after(flight, model, 1).x_m(), 5.0, 1e-9);
}

TEST(FlowOdometry, UnderestimatesTheMotionDuringASlip) {
  FlowOdometryModel model = perfect();
  model.slips_per_s = 1.0 / 20.0;
  const double x_m = estimate_after(straight_flight(8000.0), model, 1).x_m();
  // About 390 slips of 0.65 s, in each of which 45 % of 0.5 m/s is missed; three standard deviations.
  EXPECT_NEAR(4000.0 - x_m, 57.0, 9.5);
}

TEST(FlowOdometry, HoldsItsEstimateOnTheGround) {
  FlowOdometry odometry({}, 1);
  for (int i = 0; i < 1000; ++i) odometry.step(FlightState{});
  EXPECT_EQ(odometry.T_odom_body().vector(), Pose2().vector());
}

TEST(FlowOdometry, HasIndependentErrorsOfFlowAndGyro) {
  FlowOdometryModel quiet_flow;
  quiet_flow.velocity_noise_m_s = 0.0;
  quiet_flow.slips_per_s = 0.0;
  EXPECT_EQ(estimate_after(straight_flight(10.0), FlowOdometryModel{}, 1).yaw_rad(),
            estimate_after(straight_flight(10.0), quiet_flow, 1).yaw_rad());
}

TEST(FlowOdometry, DriftsLikeARealFlightInEveryWorld) {
  for (const char* world : {"office", "maze", "loop", "corridors"}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Drift drift = drift_of(world, seed);
      EXPECT_GT(drift.position_rms_m, 0.4) << world << " " << seed;
      EXPECT_LT(drift.position_rms_m, 2.2) << world << " " << seed;
      EXPECT_GT(drift.heading_range_rad, radians(10.0)) << world << " " << seed;
      EXPECT_LT(drift.heading_range_rad, radians(45.0)) << world << " " << seed;
    }
  }
}

TEST(FlowOdometry, DriftsVisiblyInTheOffice) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Drift drift = drift_of("office", seed);
    EXPECT_GT(drift.position_rms_m, 0.45) << "seed " << seed;
    EXPECT_LT(drift.position_rms_m, 1.5) << "seed " << seed;
  }
}

TEST(FlowOdometry, FollowsOnlyTheHeadingWithoutFlow) {
  FlowOdometry odometry(perfect(), 1);
  FlightState turning;
  turning.vx_body_m_s = 0.5;
  turning.yaw_rate_rad_s = 0.5;
  turning.height_m = 0.5;
  for (int i = 0; i < 100; ++i) odometry.step(turning, false);
  EXPECT_EQ(odometry.T_odom_body().x_m(), 0.0);
  EXPECT_EQ(odometry.vx_body_m_s(), 0.0);
  EXPECT_NEAR(odometry.T_odom_body().yaw_rad(), 0.5, 1e-9);
}

TEST(FlowOdometry, IsDrawnTowardsTheInitialYawInAboutTenSeconds) {
  FlowOdometry odometry(perfect(), 1);
  odometry.reset(Pose2(1.0, 2.0, 1.0));
  for (int i = 0; i < 1000; ++i) odometry.pull_yaw(0.0);
  EXPECT_NEAR(odometry.T_odom_body().yaw_rad(), std::exp(-1.0), 1e-3);
  EXPECT_EQ(odometry.T_odom_body().x_m(), 1.0);
}

TEST(FlowOdometry, TakesTheShortWayToTheInitialYaw) {
  FlowOdometry odometry(perfect(), 1);
  odometry.reset(Pose2(0.0, 0.0, 3.0));
  odometry.pull_yaw(-3.0);
  EXPECT_GT(odometry.T_odom_body().yaw_rad(), 3.0);
}

TEST(FlowOdometry, RestartsFromThePoseOfAReset) {
  FlowOdometry odometry({}, 1);
  for (const FlightState& state : straight_flight(10.0)) odometry.step(state);
  EXPECT_GT(odometry.position_variance_m2(), 0.0);
  odometry.reset(Pose2(0.5, -0.5, 0.1));
  EXPECT_EQ(odometry.T_odom_body().y_m(), -0.5);
  EXPECT_EQ(odometry.vx_body_m_s(), 0.0);
  EXPECT_EQ(odometry.position_variance_m2(), 0.0);
}

}  // namespace
}  // namespace swiftlet
