// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <utility>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/store/traversal.hpp"

namespace swiftlet {
namespace {

RefinementProblem problem_of(const ScanStore& scans, const RefinementTuning& tuning) {
  RefinementProblem problem(tuning);
  std::uint32_t count = 0;
  const std::span<const StoredScan> stored = scans.all().values();
  for (std::size_t i = 0; i < stored.size(); ++i) {
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (!beam.is_hit) continue;
      const bool held_out = count++ % tuning.hold_out_every == 0;
      problem.add(
          {make_id<PoseIndex>(i), index_of(traversal_of(stored[i])), held_out, scans.point_body(beam)});
    }
  }
  return problem;
}

/// Dead reckoning from each scan to the next.
std::vector<RelativePoseFactor<PoseIndex>> motions_of(std::span<const StoredScan> scans,
                                                      const OdometryNoise& noise) {
  std::vector<RelativePoseFactor<PoseIndex>> motions;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    RelativePoseFactor<PoseIndex> c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    if (!scans[i].starts_segment || scans[i].odometry_ran_on)
      c.T_from_to = between(scans[i - 1].T_dead_body, scans[i].T_dead_body);
    c.information = motion_information(scans[i - 1], scans[i], noise) / noise.steps_err_together;
    motions.push_back(c);
  }
  return motions;
}

}  // namespace

Result<RefinementReport> refine_scan_poses(const ScanStore& scans, const SensorModel& sensor,
                                           std::span<const RelativePoseFactor<ScanId>> closures,
                                           std::span<const HeadingFactor<ScanId>> headings,
                                           const BackendConfig& config, std::vector<Pose2>& T_map_body,
                                           const RefinementTuning& tuning) {
  SWIFTLET_CHECK(T_map_body.size() == scans.size(), "every scan has a pose");
  RefinementReport report;
  if (scans.size() < 2) return report;
  const RefinementProblem problem = problem_of(scans, tuning);
  const auto pose_of = [&](ScanId scan) { return make_id<PoseIndex>(scans.all().position(scan)); };
  std::vector<RelativePoseFactor<PoseIndex>> factors = motions_of(scans.all().values(), sensor.odometry);
  for (const RelativePoseFactor<ScanId>& c : closures)
    factors.push_back(c.joining(pose_of(c.from), pose_of(c.to)));
  PoseSystem system;
  if (Status status = system.prepare(scans.size(), factors); !status) return status.error();

  std::vector<Pose2> T = T_map_body;
  while (report.iterations < config.refinement_iterations) {
    const bool wide = report.iterations < tuning.wide_iterations;
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& f : factors) system.add(f, 1.0, T);
    for (const HeadingFactor<ScanId>& f : headings) system.add(f.of(pose_of(f.pose)), 1.0, T);
    problem.add_factors(problem.walls_at(T, wide ? tuning.wide_radius_m : tuning.radius_m), T, system);
    const Result<double> largest = system.step(T);
    if (!largest) return largest.error();
    ++report.iterations;
    if (*largest < tuning.converged_step && !wide) break;
  }
  report.judge(problem.held_out_error_m(problem.walls_at(T_map_body, tuning.radius_m), T_map_body),
               problem.held_out_error_m(problem.walls_at(T, tuning.radius_m), T));
  if (report.accepted) T_map_body = std::move(T);
  return report;
}

}  // namespace swiftlet
