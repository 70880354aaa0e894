// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <utility>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/refinement/joint_refinement.hpp"
#include "core/backend/store/traversal.hpp"

namespace swiftlet {
namespace {

RefinementProblem problem_of(const ScanStore& scans, const RefinementTuning& tuning) {
  RefinementProblem problem(tuning);
  const std::span<const StoredScan> stored = scans.all().values();
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const ScanId id = scans.all().id_at(i);
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (!beam.is_hit) continue;
      problem.add({make_id<PoseIndex>(i), index_of(traversal_of(stored[i])),
                   is_held_out(id, beam.beam, tuning), scans.point_body(beam)});
    }
  }
  return problem;
}

/// Dead reckoning from each scan to the next.
std::vector<RelativePoseFactor<PoseIndex>> motions_of(std::span<const StoredScan> scans,
                                                      const SensorModel& sensor,
                                                      DeadReckoning dead_reckoning) {
  std::vector<RelativePoseFactor<PoseIndex>> motions;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    RelativePoseFactor<PoseIndex> c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    if (dead_reckoning == DeadReckoning::kAsReported)
      c.T_from_to = reported_motion(scans[i - 1], scans[i], sensor.odometry_calibration);
    else if (!scans[i].starts_segment || scans[i].odometry_ran_on)
      c.T_from_to = between(scans[i - 1].T_dead_body, scans[i].T_dead_body);
    c.information =
        motion_information(scans[i - 1], scans[i], sensor.odometry) / sensor.odometry.steps_err_together;
    motions.push_back(c);
  }
  return motions;
}

struct Judged {
  double held_out_m = 0.0;
  double share_on_walls = 0.0;  ///< RefinementReport's
  std::vector<double> misfit;   ///< RefinementReport's
};

/// `motions`: from each scan to the next.
Judged judge(const ScanStore& scans, const RefinementProblem& problem,
             std::span<const RelativePoseFactor<PoseIndex>> motions, const std::vector<Pose2>& T_map_body,
             const RefinementTuning& tuning) {
  const std::span<const StoredScan> stored = scans.all().values();
  const std::uint32_t first = index_of(traversal_of(stored.front()));
  const WallMap walls = problem.walls_at(T_map_body, tuning.radius_m);
  Judged judged{0.0, 0.0, std::vector<double>(index_of(traversal_of(stored.back())) - first + 1)};
  std::size_t count = 0;
  for (const RelativePoseFactor<PoseIndex>& f : motions)
    judged.misfit[index_of(traversal_of(stored[index_of(f.to)])) - first] += 0.5 * chi_square(f, T_map_body);
  problem.for_held_out(walls, T_map_body, [&](std::uint32_t traversal, double distance_m) {
    judged.misfit[traversal - first] += distance_m / tuning.wall_sigma_m;
    judged.held_out_m += distance_m;
    judged.share_on_walls += distance_m < tuning.cap_sigmas * tuning.wall_sigma_m ? 1.0 : 0.0;
    ++count;
  });
  if (count == 0) return judged;
  judged.held_out_m /= static_cast<double>(count);
  judged.share_on_walls /= static_cast<double>(count);
  return judged;
}

/// Walls and poses in turn. Returns the rounds taken.
Result<int> alternate(const RefinementProblem& problem,
                      std::span<const RelativePoseFactor<PoseIndex>> factors,
                      std::span<const HeadingFactor<PoseIndex>> headings, const BackendConfig& config,
                      const RefinementTuning& tuning, std::vector<Pose2>& T_map_body) {
  PoseSystem system;
  if (Status status = system.prepare(T_map_body.size(), factors); !status) return status.error();
  for (int round = 0; round < config.refinement_iterations; ++round) {
    const bool wide = round < tuning.wide_iterations;
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& f : factors) system.add(f, 1.0, T_map_body);
    for (const HeadingFactor<PoseIndex>& f : headings) system.add(f, 1.0, T_map_body);
    problem.add_factors(problem.walls_at(T_map_body, wide ? tuning.wide_radius_m : tuning.radius_m),
                        T_map_body, system);
    const Result<double> largest = system.step(T_map_body);
    if (!largest) return largest.error();
    if (*largest < tuning.converged_step && !wide) return round + 1;
  }
  return config.refinement_iterations;
}

}  // namespace

Result<RefinementReport> refine_scan_poses(const ScanStore& scans, const SensorModel& sensor,
                                           std::span<const RelativePoseFactor<ScanId>> closures,
                                           std::span<const HeadingFactor<ScanId>> headings,
                                           const BackendConfig& config, std::vector<Pose2>& T_map_body,
                                           const RefinementTuning& tuning, DeadReckoning dead_reckoning) {
  SWIFTLET_CHECK(T_map_body.size() == scans.size(), "every scan has a pose");
  RefinementReport report;
  if (scans.size() < 2) return report;
  const RefinementProblem problem = problem_of(scans, tuning);
  const auto pose_of = [&](ScanId scan) { return make_id<PoseIndex>(scans.all().position(scan)); };
  std::vector<RelativePoseFactor<PoseIndex>> factors =
      motions_of(scans.all().values(), sensor, dead_reckoning);
  const std::size_t motions = factors.size();
  Judged before = judge(scans, problem, factors, T_map_body, tuning);
  for (const RelativePoseFactor<ScanId>& c : closures)
    factors.push_back(c.joining(pose_of(c.from), pose_of(c.to)));
  std::vector<HeadingFactor<PoseIndex>> headings_of_poses;
  for (const HeadingFactor<ScanId>& f : headings) headings_of_poses.push_back(f.of(pose_of(f.pose)));
  std::vector<Pose2> T = T_map_body;
  const Result<int> rounds = alternate(problem, factors, headings_of_poses, config, tuning, T);
  if (!rounds) return rounds.error();
  report.iterations = *rounds;
  report.moved_walls =
      refine_jointly(scans, sensor, problem.returns(), headings_of_poses, config.tuning, factors, T).ok();
  Judged after = judge(scans, problem, std::span(factors).first(motions), T, tuning);
  report.judge(before.held_out_m, after.held_out_m);
  report.share_on_walls = report.accepted ? after.share_on_walls : before.share_on_walls;
  report.misfit = report.accepted ? std::move(after.misfit) : before.misfit;
  report.misfit_at_start = std::move(before.misfit);
  if (report.accepted) T_map_body = std::move(T);
  return report;
}

}  // namespace swiftlet
