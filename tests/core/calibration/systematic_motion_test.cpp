// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_motion.hpp"

#include <gtest/gtest.h>

#include "tests/core/calibration/room_flight.hpp"

namespace swiftlet {
namespace {

RoomFlight noiseless() {
  RoomFlight flight;
  flight.scans = 200;
  flight.step_sigma_m = flight.yaw_sigma_rad = 0.0;
  return flight;
}

/// Largest difference between measured and predicted steps, metres or radians.
double largest_misprediction(const FlownScans& flown, double age_s, const SystematicErrors& errors) {
  const SystematicMotion motion(flown.scans);
  double largest = 0.0;
  for (std::size_t i = 2; i + 1 < flown.scans.size(); ++i) {
    const double period_s = 0.1;
    const double t_s = static_cast<double>(i) * period_s;
    const Pose2 moved = between(true_pose(t_s - period_s - age_s), true_pose(t_s - age_s));
    const Eigen::Vector3d off = motion.predicted(i, moved, errors).vector() - motion.measured(i).vector();
    largest = std::max(largest, off.cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(SystematicMotion, PredictsWhatIsMeasuredOfATrueMotion) {
  RoomFlight flight = noiseless();
  flight.calibration = {.forward_scale = 1.05,
                        .sideways_scale = 0.9,
                        .yaw_per_metre_rad = 0.02,
                        .yaw_per_radian = 0.03,
                        .yaw_per_second_rad = 0.004};
  SystematicErrors errors;
  errors << 0.0, 0.05, -0.1, 0.02, 0.03, 0.004;
  EXPECT_LT(largest_misprediction(fly(flight), 0.0, errors), 1e-9);
  EXPECT_GT(largest_misprediction(fly(flight), 0.0, SystematicErrors::Zero()), 1e-3);
}

TEST(SystematicMotion, ATimeOffsetMovesScansAlongTheirTwist) {
  SystematicErrors errors = SystematicErrors::Zero();
  errors(index_of(SystematicError::kRangeAge)) = 0.05;
  const FlownScans flown = fly(noiseless());
  const double without = largest_misprediction(flown, 0.05, SystematicErrors::Zero());
  EXPECT_LT(largest_misprediction(flown, 0.05, errors), 0.1 * without);
}

TEST(SystematicMotion, StampsInBunchesMakeNoVelocity) {
  RoomFlight flight = noiseless();
  FlownScans flown = fly(flight);
  flown.scans[50].measured_at = flown.scans[49].measured_at + from_seconds(0.0005);
  const SystematicMotion motion(flown.scans);
  SystematicErrors errors = SystematicErrors::Zero();
  errors(index_of(SystematicError::kRangeAge)) = 0.05;
  const Pose2 still;
  EXPECT_LT(motion.predicted(50, still, errors).vector().norm(), 1e-12);
}

TEST(SystematicMotion, AVehicleThatStandsMissesNothing) {
  FlownScans flown = fly(noiseless());
  flown.scans[50].T_odom_body = flown.scans[49].T_odom_body;
  SystematicErrors errors = SystematicErrors::Zero();
  errors(index_of(SystematicError::kYawPerSecond)) = 0.1;
  EXPECT_EQ(SystematicMotion(flown.scans).predicted(50, Pose2(), errors).vector(), Eigen::Vector3d::Zero());
}

TEST(UsualInterval, IsTheMiddleOne) {
  EXPECT_NEAR(usual_interval_s(fly(noiseless()).scans), 0.1, 1e-9);
  EXPECT_EQ(usual_interval_s({}), 0.0);
}

}  // namespace
}  // namespace swiftlet
