// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/joint_problem.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

/// A gyro's heading does not go with travel, that of wheels not with time; to estimate both would only blur
/// them, since most of the time the vehicle goes at the same pace. Stamps that come in bunches show no age.
SystematicCovariance prior_of(bool yaw_goes_with_travel, bool shows_age, const JointProblemTuning& tuning) {
  SystematicErrors sigma(tuning.prior_sigma.data());
  if (!shows_age) sigma(index_of(SystematicError::kRangeAge)) = 0.0;
  sigma(index_of(yaw_goes_with_travel ? SystematicError::kYawPerSecond : SystematicError::kYawPerMetre)) =
      0.0;
  return sigma.cwiseAbs2().asDiagonal();
}

/// Where dead reckoning was not measured, it continues as in the map, and counts for almost nothing.
RigidNodes nodes_of(std::span<const CalibrationScan> scans, const OdometryNoise& noise,
                    std::span<const Pose2> T_map_body, const RigidNodesTuning& tuning) {
  std::vector<TimedOdometry> odometry = odometry_of(scans);
  std::vector<StepVariance> variance_to(scans.size());
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const Pose2 step = scans[i].starts_segment ? between(T_map_body[i - 1], T_map_body[i])
                                               : between(scans[i - 1].T_odom_body, scans[i].T_odom_body);
    const OdometrySigma sigma =
        scans[i].starts_segment
            ? kUnknownMotion
            : odometry_sigma(noise, step, scans[i].measured_at - scans[i - 1].measured_at);
    variance_to[i] = {sigma.xy_m * sigma.xy_m, sigma.yaw_rad * sigma.yaw_rad};
    odometry[i].T_odom_body = odometry[i - 1].T_odom_body * step;
  }
  return {std::move(odometry), std::move(variance_to), tuning};
}

std::vector<ScanHit> hits_of(std::span<const CalibrationScan> scans) {
  std::vector<ScanHit> hits;
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const Point2& p_body : scans[i].hits_body)
      hits.push_back({static_cast<std::uint32_t>(i), scans[i].storey, p_body});
  return hits;
}

bool is_settled(const PosesAndWalls& problem, const JointProblemTuning& tuning) {
  const SystematicErrors sigma = problem.information().inverse().diagonal().cwiseSqrt();
  return (problem.change().array().abs() < tuning.settled * sigma.array()).all();
}

/// Ascending, for each scan. A segment begins another stretch, because the vehicle's clock may begin anew
/// there.
std::vector<std::size_t> stretch_of_scans(std::span<const CalibrationScan> scans, Duration stretch) {
  std::vector<std::size_t> numbers;
  std::size_t number = 0;
  DeviceTime begun = scans.front().measured_at;
  for (const CalibrationScan& scan : scans) {
    const Duration since = scan.measured_at - begun;
    if (!numbers.empty() && (scan.starts_segment || since >= stretch)) {
      ++number;
      begun = scan.starts_segment ? scan.measured_at : begun + since / stretch * stretch;
    }
    numbers.push_back(number);
  }
  return numbers;
}

JointEstimate summary_of(const PosesAndWalls& problem, std::span<const CalibrationScan> scans,
                         const JointProblemTuning& tuning) {
  const SystematicCovariance by_model = problem.information().inverse();
  const SystematicCovariance by_scatter =
      by_model * problem.scatter(stretch_of_scans(scans, tuning.stretch)) * by_model;
  JointEstimate estimate;
  estimate.errors = problem.errors();
  estimate.sigma = by_model.diagonal().cwiseMax(by_scatter.diagonal()).cwiseSqrt();
  const auto age = index_of(SystematicError::kRangeAge);
  if (!problem.nodes().shows_time_offset())
    estimate.sigma(age) = tuning.prior_sigma[static_cast<std::size_t>(age)];
  estimate.patches = problem.patches();
  estimate.returns_on_them = problem.returns_on_patches();
  estimate.wall_sigma_m = problem.wall_sigma_m();
  return estimate;
}

/// Where the motion is hardly larger than its noise, the estimate depends on the noise model, and scatter
/// does not show that: adds the change of the estimate when the noise is half or twice as large.
Status add_noise_uncertainty(const JointProblemTuning& tuning, PosesAndWalls& problem,
                             JointEstimate& estimate) {
  SystematicErrors furthest = SystematicErrors::Zero();
  for (const double scale : {1.0 / tuning.noise_factor, tuning.noise_factor}) {
    problem.scale_position_noise(scale);
    for (int step = 0; step < tuning.steps_per_noise; ++step)
      if (Status status = problem.step(); !status) return status;
    furthest = furthest.cwiseMax((problem.errors() - estimate.errors).cwiseAbs());
  }
  estimate.sigma = (estimate.sigma.array().square() + furthest.array().square()).sqrt();
  return {};
}

/// Poses and walls converge together, slowest where the errors are hardly observable: adds the change of the
/// estimate in the second half of the associations.
void add_convergence_uncertainty(const SystematicErrors& halfway, JointEstimate& estimate) {
  const SystematicErrors moved = estimate.errors - halfway;
  estimate.sigma = (estimate.sigma.array().square() + moved.array().square()).sqrt();
}

/// Dead reckoning is a chord between its samples, which limits the accuracy of a time offset; scatter does
/// not show that.
void add_sampling_uncertainty(double sampling_s, JointEstimate& estimate) {
  double& sigma_s = estimate.sigma(index_of(SystematicError::kRangeAge));
  sigma_s = std::hypot(sigma_s, sampling_s);
}

}  // namespace

Result<JointEstimate> estimate_jointly(std::span<const CalibrationScan> scans, const SensorModel& sensor,
                                       std::span<const Pose2> T_map_body, const GoOn& go_on,
                                       const JointProblemTuning& tuning) {
  SWIFTLET_CHECK(scans.size() >= 2 && T_map_body.size() == scans.size(), "every scan has a pose");
  RigidNodes nodes = nodes_of(scans, sensor.odometry, T_map_body, tuning.nodes);
  const SystematicCovariance prior =
      prior_of(yaw_goes_with_travel(sensor.odometry), nodes.shows_time_offset(), tuning);
  PosesAndWalls problem(std::move(nodes), hits_of(scans), {}, T_map_body, prior, sensor.range_sigma_m,
                        tuning.problem);
  SystematicErrors halfway = SystematicErrors::Zero();
  for (int round = 0; round < tuning.associations; ++round) {
    if (round == tuning.associations / 2) halfway = problem.errors();
    problem.associate();
    for (int step = 0; step < tuning.steps_per_association; ++step) {
      if (!go_on((round + static_cast<double>(step) / tuning.steps_per_association) / tuning.associations))
        return Error{ErrorCode::kTimeout, "stopped"};
      if (Status status = problem.step(); !status) return status.error();
      if (is_settled(problem, tuning)) break;
    }
  }
  JointEstimate estimate = summary_of(problem, scans, tuning);
  if (Status status = add_noise_uncertainty(tuning, problem, estimate); !status) return status.error();
  add_convergence_uncertainty(halfway, estimate);
  add_sampling_uncertainty(tuning.sampling_share * usual_interval_s(odometry_of(scans)), estimate);
  if (!estimate.errors.allFinite() || !estimate.sigma.allFinite())
    return Error{ErrorCode::kSolver, "the systematic errors of the sensors have no finite estimate"};
  return estimate;
}

}  // namespace swiftlet
