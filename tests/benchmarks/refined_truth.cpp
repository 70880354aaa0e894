// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// What the final refinement could give at best: a simulated flight is mapped as `swiftlet map` does, and the
// refinement is begun again at the true path, with nothing else of the run. Where that ends is left to the
// ranges and the dead reckoning; a better search for the path would hardly help there. Then once more with
// the wall of each return known, too: a better way to find walls would hardly lead beyond. JSON with the
// errors and how well the paths explain the ranges. For tools/benchmark-sensor-errors.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/refinement/batch_refinement.hpp"
#include "core/backend/refinement/joint_refinement.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "core/evaluation/trajectory_error.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/simulation/address.hpp"
#include "firmware_link/simulation/world.hpp"
#include "tests/benchmarks/true_walls.hpp"
#include "tools/mapped_run.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {
namespace {

std::vector<Pose2> true_path(const BatchRefinement& batch, const StampedPath& truth) {
  std::vector<Pose2> T_world_body;
  for (const StoredScan& scan : batch.stored()) T_world_body.push_back(truth.interpolated(scan.stamp));
  return T_world_body;
}

std::unique_ptr<PosesAndWalls> walls_and_poses(const BatchRefinement& batch, const BatchProblem& problem,
                                               const std::vector<Pose2>& T_map_body) {
  return joint_problem(batch.stored(), batch.sensor, problem.hits().returns(), problem.headings(),
                       batch.config.tuning, problem.factors(), T_map_body);
}

/// The final pass from where its wide radius has done its work. No held-out return refuses it: they mostly
/// prefer the truth.
Status refine(const BatchRefinement& batch, std::vector<Pose2>& T_map_body) {
  const BackendTuning& tuning = batch.config.tuning;
  BatchProblem problem(batch);
  for (int round = 0; round < batch.config.refinement_iterations; ++round)
    if (Status taken = problem.take_round(tuning.refinement.walls.radius_m, T_map_body); !taken) return taken;
  const auto together = walls_and_poses(batch, problem, T_map_body);
  for (int round = 0; round < tuning.joint.associations; ++round) {
    together->associate();
    for (int step = 0; step < tuning.joint.steps_per_association; ++step)
      if (Status taken = together->step(); !taken) return taken;
  }
  T_map_body = path_of(*together, T_map_body.front());
  return {};
}

/// Walls and poses together, with each return on its true wall and the floors as unknowns.
Status refine_on_true_walls(const BatchRefinement& batch, const SimulatedWorld& world,
                            const std::vector<Pose2>& truth, std::vector<Pose2>& T_map_body) {
  const BackendTuning& tuning = batch.config.tuning;
  const auto together = walls_and_poses(batch, BatchProblem(batch), T_map_body);
  together->let_floor_vary(tuning.floor);
  const TrueWalls walls(world.walls, together->hits(), truth);
  for (int round = 0; round < tuning.joint.associations + tuning.floor.associations; ++round) {
    together->associate_with(walls.drawn_by(together->drawn(), tuning.refinement.walls));
    for (int step = 0; step < tuning.joint.steps_per_association; ++step)
      if (Status taken = together->step(); !taken) return taken;
  }
  T_map_body = path_of(*together, T_map_body.front());
  return {};
}

Result<SimulatedWorld> world_of(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  if (!uri) return uri.error();
  const auto* address = uri->as<SimulationAddress>();
  if (address == nullptr)
    return Error{ErrorCode::kInvalidInput, input + ": nobody knows its true path; simulate a flight"};
  return make_simulated_world(address->world, address->seed);
}

std::vector<Point2> positions(const std::vector<Pose2>& path) {
  std::vector<Point2> points;
  points.reserve(path.size());
  for (const Pose2& T : path) points.push_back(T.position());
  return points;
}

double error_m(const std::vector<Pose2>& path, const std::vector<Pose2>& truth) {
  return trajectory_error(positions(path), positions(truth)).rmse_m;
}

double misfit(const BatchRefinement& batch, const std::vector<Pose2>& T_map_body) {
  const std::vector<double> by_traversal = judge_as_it_is(batch, T_map_body).misfit;
  return std::accumulate(by_traversal.begin(), by_traversal.end(), 0.0);
}

Result<nlohmann::json> measure(const MapCommand& command) {
  const Result<SimulatedWorld> world = world_of(command.input);
  if (!world) return world.error();
  Result<PreparedRun> prepared = prepare_run(command);
  if (!prepared) return prepared.error();
  const BackendConfig config = prepared->config.backend;
  const auto run =
      MappedRun::make(command, std::move(prepared).value(), std::filesystem::temp_directory_path(), {});
  if (!run) return run.error();
  const RunView view = (*run)->view();
  const BatchRefinement batch{.scans = view.backend.scans(), .sensor = view.sensor, .config = config};
  const std::vector<Pose2> truth = true_path(batch, StampedPath(view.truth));
  std::vector<Pose2> refined = truth;
  if (Status done = refine(batch, refined); !done) return done.error();
  std::vector<Pose2> on_true_walls = truth;
  if (Status done = refine_on_true_walls(batch, *world, truth, on_true_walls); !done) return done.error();
  std::vector<Pose2> mapped;
  for (const auto& [id, scan] : view.backend.scans().all()) mapped.push_back(view.backend.T_map_body(id));
  std::vector<Pose2> reported;
  for (const StoredScan& scan : batch.stored()) reported.push_back(scan.T_odom_body);
  return nlohmann::json{
      {"odometry_m", error_m(reported, truth)},  {"final_m", error_m(mapped, truth)},
      {"from_truth_m", error_m(refined, truth)}, {"on_true_walls_m", error_m(on_true_walls, truth)},
      {"final_misfit", misfit(batch, mapped)},   {"from_truth_misfit", misfit(batch, refined)}};
}

int run(const char* input) {
  MapCommand command;
  command.input = input;
  const Result<nlohmann::json> measured = measure(command);
  if (!measured) {
    std::fprintf(stderr, "refined_truth: %s\n", measured.error().message.c_str());
    return 2;
  }
  std::printf("%s\n", measured->dump().c_str());
  return 0;
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: refined_truth FLIGHT, as in refined_truth 'sim://building?seed=1'\n");
    return 2;
  }
  try {
    return swiftlet::run(argv[1]);
  } catch (const std::exception& error) {  // out of memory, or a fault of a library's
    std::fprintf(stderr, "refined_truth: %s\n", error.what());
    return 2;
  }
}
