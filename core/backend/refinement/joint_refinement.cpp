// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/joint_refinement.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/sensing/systematic_motion.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {
namespace {

using Factor = RelativePoseFactor<PoseIndex>;

constexpr double kWallSigmasOfReading = 1.7;  // at least: a wall is no plane, and the error of a scan's pose
                                              // is in all of its returns

/// Of the systematic errors that whole walls show best: the age of the ranges and the scales.
SystematicCovariance prior_of(const SensorModel& sensor, bool shows_age,
                              const JointRefinementTuning& tuning) {
  SystematicPrior prior;
  prior.range_age_s = shows_age ? tuning.age_sigma_s : 0.0;
  prior.yaw_per_radian = prior.yaw_per_second_rad = 0.0;
  return covariance_of(prior, yaw_goes_with_travel(sensor.odometry));
}

std::vector<ScanHit> hits_of(std::span<const PlacedReturn> returns) {
  std::vector<ScanHit> hits;
  hits.reserve(returns.size());
  for (const PlacedReturn& r : returns)
    if (!r.held_out) hits.push_back({index_of(r.pose), r.storey, r.p_body});
  return hits;
}

Status solve(PosesAndWalls& problem, int associations, int steps_per_association) {
  for (int round = 0; round < associations; ++round) {
    problem.associate();
    for (int step = 0; step < steps_per_association; ++step)
      if (Status status = problem.step(); !status) return status;
  }
  return {};
}

void take(const PosesAndWalls& problem, std::vector<Factor>& factors, std::vector<Pose2>& T_map_body) {
  T_map_body = path_of(problem, T_map_body.front());
  for (std::size_t i = 1; i < T_map_body.size(); ++i) factors[i - 1].T_from_to = problem.nodes().step_to(i);
}

/// A step from a node's scan is a part of the motion to the next node; behind the last node there is none. A
/// step that was not measured is as long as it is.
FloorFindings floor_of(const PosesAndWalls& problem, std::span<const StoredScan> scans) {
  const FloorField& floor = *problem.floor();
  FloorFindings found{floor.cost(), std::vector<double>(scans.size(), 1.0)};
  const RigidNodes& nodes = problem.nodes();
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (scans[i].starts_segment) continue;
    const std::size_t to = std::min(nodes.node_of(i - 1) + 1, nodes.size() - 1);
    found.step_scale[i] = 1.0 + floor.error(floor.cell_of(to));
  }
  return found;
}

}  // namespace

RigidNodes nodes_of(std::span<const StoredScan> scans, std::span<const Factor> motions,
                    const RigidNodesTuning& tuning) {
  std::vector<TimedOdometry> odometry;
  std::vector<StepVariance> variance_to;
  Pose2 T_first_body;
  odometry.reserve(scans.size());
  variance_to.reserve(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    StepVariance variance;
    if (i > 0) {
      T_first_body = T_first_body * motions[i - 1].T_from_to;
      variance = {1.0 / motions[i - 1].information(0, 0), 1.0 / motions[i - 1].information(2, 2)};
    }
    variance_to.push_back(variance);
    odometry.push_back({scans[i].measured_at, T_first_body, scans[i].starts_segment});
  }
  return {std::move(odometry), std::move(variance_to), tuning};
}

std::unique_ptr<PosesAndWalls> joint_problem(std::span<const StoredScan> scans, const SensorModel& sensor,
                                             std::span<const PlacedReturn> returns,
                                             std::span<const HeadingFactor<PoseIndex>> headings,
                                             const BackendTuning& tuning, std::span<const Factor> factors,
                                             std::span<const Pose2> T_map_body) {
  const std::span<const Factor> motions = factors.first(scans.size() - 1);
  const std::span<const Factor> closures = factors.subspan(scans.size() - 1);
  RigidNodes nodes = nodes_of(scans, motions, tuning.nodes);
  const SystematicCovariance prior = prior_of(sensor, nodes.shows_time_offset(), tuning.joint);
  PoseKnowledge known{
      {closures.begin(), closures.end()}, {headings.begin(), headings.end()}, tuning.joint.closure_weight};
  return std::make_unique<PosesAndWalls>(
      std::move(nodes), hits_of(returns), std::move(known), T_map_body, prior,
      kWallSigmasOfReading * sensor.range_sigma_m,
      PosesAndWalls::Tuning{tuning.poses_and_walls, tuning.refinement.walls, tuning.patches});
}

std::vector<Pose2> path_of(const PosesAndWalls& problem, const Pose2& T_map_first) {
  std::vector<Pose2> T_map_body = problem.nodes().blended(problem.T_map_node());
  T_map_body.front() = T_map_first;  // but for rounding it has not moved
  return T_map_body;
}

Status refine_jointly(std::span<const StoredScan> scans, const SensorModel& sensor,
                      std::span<const PlacedReturn> returns,
                      std::span<const HeadingFactor<PoseIndex>> headings, const BackendTuning& tuning,
                      std::vector<Factor>& factors, std::vector<Pose2>& T_map_body) {
  const auto problem = joint_problem(scans, sensor, returns, headings, tuning, factors, T_map_body);
  Status status = solve(*problem, tuning.joint.associations, tuning.joint.steps_per_association);
  if (status) take(*problem, factors, T_map_body);
  return status;
}

Result<FloorFindings> refine_jointly_with_floor(std::span<const StoredScan> scans, const SensorModel& sensor,
                                                std::span<const PlacedReturn> returns,
                                                std::span<const HeadingFactor<PoseIndex>> headings,
                                                const BackendTuning& tuning, std::vector<Factor>& factors,
                                                std::vector<Pose2>& T_map_body) {
  const auto problem = joint_problem(scans, sensor, returns, headings, tuning, factors, T_map_body);
  problem->let_floor_vary(tuning.floor);
  Status status = solve(*problem, tuning.floor.associations, tuning.joint.steps_per_association);
  if (!status) return status.error();
  take(*problem, factors, T_map_body);
  FloorFindings found;
  if (problem->nodes().size() > 1) found = floor_of(*problem, scans);
  for (std::size_t i = 1; i < found.step_scale.size(); ++i)
    factors[i - 1].T_from_to = stretched(factors[i - 1].T_from_to, found.step_scale[i]);
  return found;
}

}  // namespace swiftlet
