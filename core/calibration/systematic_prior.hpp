// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/calibration/joint_problem.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Standard deviations of the systematic errors of an input of which nothing else is known.
struct SystematicPrior {
  double range_age_s = 0.1;      ///< about a scan period
  double scale = 0.03;           ///< of odometry
  double scales_apart = 0.01;    ///< forward and sideways: one flow sensor measures both, at one height
  double yaw_per_radian = 0.01;  ///< of a gyro; that of wheels is learnt by the frontend
  double yaw_per_second_rad = 0.002;
  double sigma_factor = 2.0;  ///< estimates from different maps differ by more than their sigmas
};

/// Posterior mean and standard deviation: what a run shows little of stays near zero.
[[nodiscard]] JointEstimate weighed(JointEstimate measured, const SensorModel& sensor,
                                    const SystematicPrior& prior = {});

/// What an input shows of its own sensors.
struct InputCalibration {
  SensorModel expected;
  SensorModel found;
  SystematicErrors sigma = SystematicErrors::Zero();  ///< of what was found; 0: not estimated
};
/// `estimate` is relative to the expected range age, and to no calibration of the odometry. An age is not
/// below zero.
[[nodiscard]] InputCalibration calibrated_by(const JointEstimate& estimate, const SensorModel& expected);

}  // namespace swiftlet
