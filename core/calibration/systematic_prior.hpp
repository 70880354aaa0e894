// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/calibration/joint_problem.hpp"
#include "core/sensing/sensor_model.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {

/// Posterior mean and standard deviation: what a run shows little of stays near zero. `sigma_factor`:
/// estimates from different maps differ by more than their sigmas. The yaw that wheels miss becomes relative
/// to the calibration of `sensor`, so that what a run shows little of leaves that calibration as it is.
[[nodiscard]] JointEstimate weighed(JointEstimate measured, const SensorModel& sensor,
                                    const SystematicPrior& prior, double sigma_factor = 2.0);

/// What an input shows of its own sensors.
struct InputCalibration {
  SensorModel expected;
  SensorModel found;
  SystematicErrors sigma = SystematicErrors::Zero();  ///< of what was found; 0: not estimated
};
/// `estimate`, as weighed() returns it, is relative to the expected range age, and to no calibration of the
/// odometry but for the yaw of wheels. The yaw that wheels miss becomes what the frontend expects of it: it
/// differs along the way, so the frontend goes on learning it. Dead reckoning of wheels as a map of its own
/// stays as reported, scale and yaw.
[[nodiscard]] InputCalibration calibrated_by(const JointEstimate& estimate, const SensorModel& expected);

}  // namespace swiftlet
