// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <utility>

#include "core/backend/refinement/dead_reckoning_misfit.hpp"
#include "core/backend/refinement/joint_refinement.hpp"
#include "core/backend/store/traversal.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {
namespace {

struct Judged {
  double held_out_m = 0.0;
  double share_on_walls = 0.0;  ///< RefinementReport's
  double of_returns = 0.0;      ///< of the misfit
  std::vector<double> misfit;   ///< RefinementReport's
};

bool is_on_wall(double judged_distance_m, const RefinementTuning& tuning) {
  return judged_distance_m < tuning.cap_sigmas * tuning.wall_sigma_m;
}

Judged judge(const BatchRefinement& batch, const BatchProblem& problem,
             std::span<const BatchProblem::Factor> motions, const std::vector<Pose2>& T_map_body) {
  const RefinementTuning& tuning = batch.config.tuning.refinement;
  const std::span<const StoredScan> stored = batch.stored();
  const std::uint32_t first = index_of(traversal_of(stored.front()));
  const WallsByStorey walls = problem.hits().walls_at(T_map_body, tuning.walls.radius_m);
  Judged judged{0.0, 0.0, 0.0, std::vector<double>(index_of(traversal_of(stored.back())) - first + 1)};
  std::size_t count = 0;
  for (const BatchProblem::Factor& f : motions)
    judged.misfit[index_of(traversal_of(stored[index_of(f.to)])) - first] +=
        0.5 * dcs_cost(chi_square(f, T_map_body), batch.config.dcs_phi);
  problem.hits().for_held_out(walls, T_map_body, [&](std::uint32_t traversal, double distance_m) {
    judged.misfit[traversal - first] += distance_m / tuning.wall_sigma_m;
    judged.of_returns += distance_m / tuning.wall_sigma_m;
    judged.held_out_m += distance_m;
    judged.share_on_walls += is_on_wall(distance_m, tuning) ? 1.0 : 0.0;
    ++count;
  });
  if (count == 0) return judged;
  judged.held_out_m /= static_cast<double>(count);
  judged.share_on_walls /= static_cast<double>(count);
  return judged;
}

/// Walls and poses in turn. Single poses jump between walls for ever: there is no end but the last round.
Status alternate(BatchProblem& problem, const BackendConfig& config, std::vector<Pose2>& T_map_body) {
  const RefinementTuning& tuning = config.tuning.refinement;
  for (int round = 0; round < config.refinement_iterations; ++round) {
    const double radius_m = round < tuning.wide_iterations ? tuning.wide_radius_m : tuning.walls.radius_m;
    if (Status status = problem.take_round(radius_m, T_map_body); !status) return status;
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
void take_together(Judged refined, std::vector<Pose2> T_refined, RefinementReport& report,
                   std::vector<Pose2>& T_map_body) {
  HeldOutVerdict verdict;
  verdict.judge(report.held_out_before_m, refined.held_out_m);
  report.moved_walls = report.accepted || verdict.accepted;
  if (!report.moved_walls) return;
  report.held_out_after_m = refined.held_out_m;
  report.accepted = true;
  take(std::move(refined), std::move(T_refined), report, T_map_body);
}

}  // namespace

RefinementReport judge_as_it_is(const BatchRefinement& batch, const std::vector<Pose2>& T_map_body) {
  const BatchProblem problem(batch);
  Judged judged = judge(batch, problem, problem.motions(), T_map_body);
  RefinementReport report;
  report.judge(judged.held_out_m, judged.held_out_m);
  report.share_on_walls = judged.share_on_walls;
  report.misfit = judged.misfit;
  report.misfit_at_start = std::move(judged.misfit);
  RigidNodes nodes = nodes_of(batch.stored(), problem.motions(), batch.config.tuning.nodes);
  SystematicPrior prior = systematic_prior(batch.sensor.odometry);
  if (!nodes.shows_time_offset()) prior.range_age_s = 0.0;
  report.misfit_of_path =
      judged.of_returns +
      dead_reckoning_misfit(std::move(nodes),
                            covariance_of(prior, yaw_goes_with_travel(batch.sensor.odometry)), T_map_body,
                            batch.config.dcs_phi);
  return report;
}

double share_on_walls_of_any(const BatchRefinement& batch, const std::vector<Pose2>& T_map_body) {
  const RefinementTuning& tuning = batch.config.tuning.refinement;
  RefinementProblem hits(tuning);
  const BatchProblem problem(batch);
  for (PlacedReturn placed : problem.hits().returns()) {
    placed.traversal = index_of(placed.pose);  // each scan is a traversal of its own
    hits.add(placed);
  }
  std::size_t on_walls = 0;
  std::size_t count = 0;
  hits.for_held_out(hits.walls_at(T_map_body, tuning.walls.radius_m), T_map_body,
                    [&](std::uint32_t, double distance_m) {
                      on_walls += is_on_wall(distance_m, tuning) ? 1U : 0U;
                      ++count;
                    });
  return count > 0 ? static_cast<double>(on_walls) / static_cast<double>(count) : 0.0;
}

Result<RefinementReport> refine_in_turn(const BatchRefinement& batch, std::vector<Pose2>& T_map_body) {
  SWIFTLET_CHECK(T_map_body.size() == batch.stored().size(), "every scan has a pose");
  RefinementReport report;
  if (batch.stored().size() < 2) return report;
  BatchProblem problem(batch);
  Judged start = judge(batch, problem, problem.motions(), T_map_body);
  report.share_on_walls = start.share_on_walls;
  report.misfit = start.misfit;
  report.misfit_at_start = std::move(start.misfit);
  std::vector<Pose2> T = T_map_body;
  if (Status moved = alternate(problem, batch.config, T); !moved) return moved.error();
  Judged refined = judge(batch, problem, problem.motions(), T);
  report.judge(start.held_out_m, refined.held_out_m);
  if (report.accepted) take(std::move(refined), std::move(T), report, T_map_body);
  return report;
}

Status refine_together(const BatchRefinement& batch, RefinementReport& report,
                       std::vector<Pose2>& T_map_body) {
  if (batch.stored().size() < 2) return {};
  const BatchProblem problem(batch);
  std::vector<BatchProblem::Factor> factors = problem.factors();
  std::vector<Pose2> T = T_map_body;
  Status solved = refine_jointly(batch.stored(), batch.sensor, problem.hits().returns(), problem.headings(),
                                 batch.config.tuning, factors, T);
  if (!solved) return solved;
  Judged refined = judge(batch, problem, std::span(factors).first(T.size() - 1), T);
  take_together(std::move(refined), std::move(T), report, T_map_body);
  return {};
}

Result<FloorFindings> refine_together_with_floor(const BatchRefinement& batch, RefinementReport& report,
                                                 std::vector<Pose2>& T_map_body) {
  if (batch.stored().size() < 2) return FloorFindings();
  const BatchProblem problem(batch);
  std::vector<BatchProblem::Factor> factors = problem.factors();
  std::vector<Pose2> T = T_map_body;
  Result<FloorFindings> floor =
      refine_jointly_with_floor(batch.stored(), batch.sensor, problem.hits().returns(), problem.headings(),
                                batch.config.tuning, factors, T);
  if (!floor) return floor;
  Judged refined = judge(batch, problem, std::span(factors).first(T.size() - 1), T);
  take_together(std::move(refined), std::move(T), report, T_map_body);
  return report.moved_walls ? std::move(floor) : FloorFindings();
}

}  // namespace swiftlet
