// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <utility>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/refinement/joint_refinement.hpp"
#include "core/backend/store/traversal.hpp"

namespace swiftlet {
namespace {

using Factors = std::vector<RelativePoseFactor<PoseIndex>>;
using Headings = std::vector<HeadingFactor<PoseIndex>>;

RefinementProblem problem_of(const ScanStore& scans, const RefinementTuning& tuning) {
  RefinementProblem problem(tuning);
  const std::span<const StoredScan> stored = scans.all().values();
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const ScanId id = scans.all().id_at(i);
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (!beam.is_hit) continue;
      problem.add({make_id<PoseIndex>(i), index_of(traversal_of(stored[i])), stored[i].storey,
                   is_held_out(id, beam.beam, tuning), scans.point_body(beam)});
    }
  }
  return problem;
}

/// Dead reckoning from each scan to the next.
Factors motions_of(std::span<const StoredScan> scans, const SensorModel& sensor,
                   DeadReckoning dead_reckoning) {
  Factors motions;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    RelativePoseFactor<PoseIndex> c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    if (dead_reckoning == DeadReckoning::kAsReported)
      c.T_from_to = reported_motion(scans[i - 1], scans[i], sensor.calibration_as_reported());
    else if (!scans[i].starts_segment || scans[i].odometry_ran_on)
      c.T_from_to = between(scans[i - 1].T_dead_body, scans[i].T_dead_body);
    c.information =
        motion_information(scans[i - 1], scans[i], sensor.odometry) / sensor.odometry.steps_err_together;
    motions.push_back(c);
  }
  return motions;
}

void stretch(Factors& motions, std::span<const double> step_scale) {
  for (std::size_t i = 1; i < step_scale.size(); ++i)
    motions[i - 1].T_from_to = stretched(motions[i - 1].T_from_to, step_scale[i]);
}

/// The dead reckoning among factors_of().
std::span<const RelativePoseFactor<PoseIndex>> motions_in(const Factors& factors,
                                                          const BatchRefinement& batch) {
  return std::span(factors).first(batch.scans.size() - 1);
}

PoseIndex pose_of(const BatchRefinement& batch, ScanId scan) {
  return make_id<PoseIndex>(batch.scans.all().position(scan));
}

struct Judged {
  double held_out_m = 0.0;
  double share_on_walls = 0.0;  ///< RefinementReport's
  std::vector<double> misfit;   ///< RefinementReport's
};

/// `motions`: from each scan to the next.
Judged judge(const ScanStore& scans, const RefinementProblem& problem,
             std::span<const RelativePoseFactor<PoseIndex>> motions, const std::vector<Pose2>& T_map_body,
             const BackendConfig& config) {
  const RefinementTuning& tuning = config.tuning.refinement;
  const std::span<const StoredScan> stored = scans.all().values();
  const std::uint32_t first = index_of(traversal_of(stored.front()));
  const WallsByStorey walls = problem.walls_at(T_map_body, tuning.walls.radius_m);
  Judged judged{0.0, 0.0, std::vector<double>(index_of(traversal_of(stored.back())) - first + 1)};
  std::size_t count = 0;
  for (const RelativePoseFactor<PoseIndex>& f : motions)
    judged.misfit[index_of(traversal_of(stored[index_of(f.to)])) - first] +=
        0.5 * dcs_cost(chi_square(f, T_map_body), config.dcs_phi);
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

/// Dead reckoning from each scan to the next, then closures.
Factors factors_of(const BatchRefinement& batch) {
  Factors factors = motions_of(batch.scans.all().values(), batch.sensor, batch.dead_reckoning);
  stretch(factors, batch.step_scale);
  for (const RelativePoseFactor<ScanId>& c : batch.closures)
    factors.push_back(c.joining(pose_of(batch, c.from), pose_of(batch, c.to)));
  return factors;
}

Headings headings_of(const BatchRefinement& batch) {
  Headings headings;
  for (const HeadingFactor<ScanId>& f : batch.headings) headings.push_back(f.of(pose_of(batch, f.pose)));
  return headings;
}

/// Walls and poses in turn. Single poses jump between walls for ever: there is no end but the last round.
Status alternate(const RefinementProblem& problem, const Factors& factors, const Headings& headings,
                 const BackendConfig& config, std::vector<Pose2>& T_map_body) {
  const RefinementTuning& tuning = config.tuning.refinement;
  PoseSystem system;
  if (Status status = system.prepare(T_map_body.size(), factors); !status) return status;
  for (int round = 0; round < config.refinement_iterations; ++round) {
    const double radius_m = round < tuning.wide_iterations ? tuning.wide_radius_m : tuning.walls.radius_m;
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& f : factors) system.add(f, 1.0, T_map_body);
    for (const HeadingFactor<PoseIndex>& f : headings) system.add(f, 1.0, T_map_body);
    problem.add_factors(problem.walls_at(T_map_body, radius_m), T_map_body, system);
    if (const Result<double> largest = system.step(T_map_body); !largest) return largest.error();
  }
  return {};
}

/// Takes refined poses, which have been accepted.
void take(Judged refined, std::vector<Pose2> T_refined, RefinementReport& report,
          std::vector<Pose2>& T_map_body) {
  report.share_on_walls = refined.share_on_walls;
  report.misfit = std::move(refined.misfit);
  T_map_body = std::move(T_refined);
}

/// Of walls and poses together.
void take_if_held_out_agree(Judged refined, std::vector<Pose2> T_refined, RefinementReport& report,
                            std::vector<Pose2>& T_map_body) {
  HeldOutVerdict verdict;
  verdict.judge(report.held_out_before_m, refined.held_out_m);
  report.moved_walls = verdict.accepted;
  if (!verdict.accepted) return;
  static_cast<HeldOutVerdict&>(report) = verdict;
  take(std::move(refined), std::move(T_refined), report, T_map_body);
}

}  // namespace

RefinementReport judge_as_it_is(const BatchRefinement& batch, const std::vector<Pose2>& T_map_body) {
  const RefinementProblem problem = problem_of(batch.scans, batch.config.tuning.refinement);
  const Factors factors = factors_of(batch);
  Judged judged = judge(batch.scans, problem, motions_in(factors, batch), T_map_body, batch.config);
  RefinementReport report;
  report.judge(judged.held_out_m, judged.held_out_m);
  report.share_on_walls = judged.share_on_walls;
  report.misfit = judged.misfit;
  report.misfit_at_start = std::move(judged.misfit);
  return report;
}

Result<RefinementReport> refine_in_turn(const BatchRefinement& batch, std::vector<Pose2>& T_map_body) {
  SWIFTLET_CHECK(T_map_body.size() == batch.scans.size(), "every scan has a pose");
  RefinementReport report;
  if (batch.scans.size() < 2) return report;
  const RefinementTuning& tuning = batch.config.tuning.refinement;
  const RefinementProblem problem = problem_of(batch.scans, tuning);
  const Factors factors = factors_of(batch);
  Judged start = judge(batch.scans, problem, motions_in(factors, batch), T_map_body, batch.config);
  report.share_on_walls = start.share_on_walls;
  report.misfit = start.misfit;
  report.misfit_at_start = std::move(start.misfit);
  std::vector<Pose2> T = T_map_body;
  if (Status moved = alternate(problem, factors, headings_of(batch), batch.config, T); !moved)
    return moved.error();
  Judged refined = judge(batch.scans, problem, motions_in(factors, batch), T, batch.config);
  report.judge(start.held_out_m, refined.held_out_m);
  if (report.accepted) take(std::move(refined), std::move(T), report, T_map_body);
  return report;
}

Status refine_together(const BatchRefinement& batch, RefinementReport& report,
                       std::vector<Pose2>& T_map_body) {
  if (batch.scans.size() < 2) return {};
  const RefinementProblem problem = problem_of(batch.scans, batch.config.tuning.refinement);
  Factors factors = factors_of(batch);
  std::vector<Pose2> T = T_map_body;
  Status solved = refine_jointly(batch.scans, batch.sensor, problem.returns(), headings_of(batch),
                                 batch.config.tuning, factors, T);
  if (!solved) return solved;
  Judged refined = judge(batch.scans, problem, motions_in(factors, batch), T, batch.config);
  take_if_held_out_agree(std::move(refined), std::move(T), report, T_map_body);
  return {};
}

Result<FloorFindings> refine_together_with_floor(const BatchRefinement& batch, RefinementReport& report,
                                                 std::vector<Pose2>& T_map_body) {
  if (batch.scans.size() < 2) return FloorFindings();
  const RefinementProblem problem = problem_of(batch.scans, batch.config.tuning.refinement);
  Factors factors = factors_of(batch);
  std::vector<Pose2> T = T_map_body;
  Result<FloorFindings> floor = refine_jointly_with_floor(
      batch.scans, batch.sensor, problem.returns(), headings_of(batch), batch.config.tuning, factors, T);
  if (!floor) return floor;
  Judged refined = judge(batch.scans, problem, motions_in(factors, batch), T, batch.config);
  take_if_held_out_agree(std::move(refined), std::move(T), report, T_map_body);
  return report.moved_walls ? std::move(floor) : FloorFindings();
}

}  // namespace swiftlet
