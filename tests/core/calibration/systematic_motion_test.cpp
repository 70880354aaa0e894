// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/systematic_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/core/calibration/room_flight.hpp"

namespace swiftlet {
namespace {

RoomFlight noiseless() {
  RoomFlight flight;
  flight.scans = 200;
  flight.step_sigma_m = flight.yaw_sigma_rad = 0.0;
  return flight;
}

constexpr double kPeriodS = 0.1;

/// Largest difference between corrected and true steps, metres or radians.
double largest_error(const FlownScans& flown, double age_s, const SystematicErrors& errors) {
  SystematicMotion motion(odometry_of(flown.scans));
  const std::span<const CorrectedStep> steps = motion.correct(errors);
  double largest = 0.0;
  for (std::size_t i = 8; i + 8 < flown.scans.size(); ++i) {
    const double t_s = static_cast<double>(i) * kPeriodS;
    const Pose2 moved = between(true_pose(t_s - kPeriodS - age_s), true_pose(t_s - age_s));
    const Eigen::Vector3d off = steps[i].T_previous_this.vector() - moved.vector();
    largest = std::max(largest, off.cwiseAbs().maxCoeff());
  }
  return largest;
}

SystematicErrors aged(double seconds) {
  SystematicErrors errors = SystematicErrors::Zero();
  errors(index_of(SystematicError::kRangeAge)) = seconds;
  return errors;
}

TEST(SystematicMotion, CorrectsWhatIsMeasuredToTheTrueMotion) {
  RoomFlight flight = noiseless();
  flight.calibration = {.forward_scale = 1.05,
                        .sideways_scale = 0.9,
                        .yaw_per_metre_rad = 0.02,
                        .yaw_per_radian = 0.03,
                        .yaw_per_second_rad = 0.004};
  SystematicErrors errors;
  errors << 0.0, 0.05, -0.1, 0.02, 0.03, 0.004;
  EXPECT_LT(largest_error(fly(flight), 0.0, errors), 1e-9);
  EXPECT_GT(largest_error(fly(flight), 0.0, SystematicErrors::Zero()), 1e-3);
}

TEST(SystematicMotion, ATimeOffsetMovesScansAlongTheDeadReckoning) {
  const FlownScans flown = fly(noiseless());
  for (const double age_s : {-0.25, -0.05, 0.05, 0.3}) {
    const double without = largest_error(flown, age_s, SystematicErrors::Zero());
    EXPECT_LT(largest_error(flown, age_s, aged(age_s)), 0.15 * without) << age_s;
  }
}

TEST(SystematicMotion, KnowsHowItsStepsChangeWithTheErrors) {
  RoomFlight flight = noiseless();
  const FlownScans flown = fly(flight);
  SystematicErrors errors;
  errors << 0.13, 0.05, -0.1, 0.02, 0.03, 0.004;
  SystematicMotion motion(odometry_of(flown.scans));
  const std::vector<CorrectedStep> steps(motion.correct(errors).begin(), motion.correct(errors).end());
  for (Eigen::Index k = 0; k < errors.size(); ++k) {
    const double nudge = 1e-4;
    SystematicMotion less(odometry_of(flown.scans));
    SystematicMotion more(odometry_of(flown.scans));
    const auto before = less.correct(errors - nudge * SystematicErrors::Unit(k));
    const auto after = more.correct(errors + nudge * SystematicErrors::Unit(k));
    for (std::size_t i = 8; i + 8 < steps.size(); ++i) {
      const Eigen::Vector3d slope =
          (after[i].T_previous_this.vector() - before[i].T_previous_this.vector()) / (2.0 * nudge);
      // A chord's slope and the central difference differ by the noiseless path's bend.
      EXPECT_LT((steps[i].by_errors.col(k) - slope).norm(), k == 0 ? 0.002 : 1e-6) << i << " by " << k;
    }
  }
}

TEST(SystematicMotion, StampsInBunchesMakeNoVelocity) {
  FlownScans flown = fly(noiseless());
  flown.scans[50].measured_at = flown.scans[49].measured_at + from_seconds(0.0005);
  SystematicMotion motion(odometry_of(flown.scans));
  const Pose2 step = motion.correct(aged(0.05))[50].T_previous_this;
  EXPECT_LT((step.vector() - motion.measured(50).vector()).norm(), 1e-12);
}

TEST(SystematicMotion, AVehicleThatStandsMissesNothing) {
  FlownScans flown = fly(noiseless());
  flown.scans[50].T_odom_body = flown.scans[49].T_odom_body;
  SystematicErrors errors = SystematicErrors::Zero();
  errors(index_of(SystematicError::kYawPerSecond)) = 0.1;
  EXPECT_EQ(SystematicMotion(odometry_of(flown.scans)).correct(errors)[50].T_previous_this.vector(),
            Eigen::Vector3d::Zero());
}

TEST(UsualInterval, IsTheMiddleOne) {
  EXPECT_NEAR(usual_interval_s(odometry_of(fly(noiseless()).scans)), 0.1, 1e-9);
  EXPECT_EQ(usual_interval_s({}), 0.0);
}

}  // namespace
}  // namespace swiftlet
