// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// The backend's costly steps, on flights around a corridor and on growing graphs.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"
#include "core/backend/refinement/batch_refinement.hpp"
#include "core/base/check.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/random_draws.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kSubmapKeyframes = 12;  // 6 m of travel

KeyframeId keyframe(std::size_t i) { return static_cast<KeyframeId>(i); }

/// Exact dead reckoning, a lap and the first side of the next.
TestVehicle lap_and_a_side() {
  TestVehicle vehicle = vehicle_at_start({}, 7);
  fly_along(vehicle, loop_corridor(), "bcdab");
  return vehicle;
}

/// The last 6 m of the first side on the first lap: where the flight ends on its second.
Submap submap_of_the_place(const StoredRun& run) {
  constexpr std::uint32_t kFirst = 11;
  return build_submap(keyframe(kFirst), keyframe(kFirst + kSubmapKeyframes), run.scans(), run.chain(),
                      run.T_local_keyframe(), {});
}

void submap_build(benchmark::State& state) {
  const StoredRun run(lap_and_a_side().samples());
  while (state.KeepRunning()) benchmark::DoNotOptimize(submap_of_the_place(run));
}
BENCHMARK(submap_build)->Unit(benchmark::kMillisecond);

/// The last 6 m as the loop detector sees them: hits in the frame of the newest keyframe, one a cell.
std::vector<Point2> recent_points(const StoredRun& run) {
  constexpr double kCellM = 0.1;
  const Pose2 T_query_local = run.T_local_keyframe().values().back().inverse();
  std::vector<Point2> points;
  std::set<std::pair<int, int>> taken;
  const auto oldest = keyframe(index_of(run.newest()) - kSubmapKeyframes);
  for (ScanId i = run.chain().scan_of(oldest); i <= run.chain().scan_of(run.newest()); ++i) {
    const Pose2 T_query_body = T_query_local * run.chain().T_w_body(i, run.T_local_keyframe());
    for (const ScanReturn& beam : run.scans().returns(i)) {
      if (!beam.is_hit) continue;
      const Point2 p = T_query_body * run.scans().point_body(beam);
      const std::pair cell(static_cast<int>(std::floor(p.x_m / kCellM)),
                           static_cast<int>(std::floor(p.y_m / kCellM)));
      if (taken.insert(cell).second) points.push_back(p);
    }
  }
  return points;
}

/// Finds the place again from a prediction that is off by half the window.
void match(benchmark::State& state) {
  const BackendConfig config;
  const double radius_m = 0.1 * static_cast<double>(state.range(0));
  const double angle_rad = radians(static_cast<double>(state.range(1)));
  const StoredRun run(lap_and_a_side().samples());
  const Submap submap = submap_of_the_place(run);
  const std::vector<Point2> points = recent_points(run);
  const Pose2 T_submap_scan =
      between(run.T_local_keyframe()[submap.reference], run.T_local_keyframe().values().back());
  const SearchWindow window{T_submap_scan * Pose2(0.5 * radius_m, -0.5 * radius_m, 0.5 * angle_rad), radius_m,
                            angle_rad};
  while (state.KeepRunning()) {
    const std::optional<MatchResult> found =
        CorrelativeMatcher(submap, points, window).match(config.min_score);
    SWIFTLET_CHECK(found, "the place is recognised");
  }
  state.counters["points"] = static_cast<double>(points.size());
}
// The narrowest window, one after some drift, the widest.
BENCHMARK(match)
    ->ArgNames({"radius_dm", "angle_deg"})
    ->Args({5, 6})
    ->Args({15, 15})
    ->Args({40, 30})
    ->Unit(benchmark::kMillisecond);

Pose2 disturbed(const Pose2& T_a_b, std::mt19937& random, double sigma_m, double sigma_rad) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const double x_m = sigma_m * noise(random);
  const double y_m = sigma_m * noise(random);
  return T_a_b * Pose2(x_m, y_m, sigma_rad * noise(random));
}

/// Laps around a circle of 40 keyframes, half a metre apart; every fourth is matched with its place a lap
/// before. The poses are off by as much as the measurements.
PoseGraph laps(std::size_t poses) {
  constexpr std::size_t kLap = 40;
  constexpr double kSigmaM = 0.02;
  constexpr double kSigmaRad = 0.01;
  const Eigen::Vector3d sigma(kSigmaM, kSigmaM, kSigmaRad);
  const Eigen::Matrix3d information = sigma.array().square().inverse().matrix().asDiagonal();
  const Pose2 step(0.5, 0.0, 2.0 * kPi / kLap);
  std::mt19937 random(1);
  PoseGraph graph;
  Pose2 T_map_keyframe;
  for (std::size_t i = 0; i < poses; ++i) {
    graph.T_map_keyframe.push_back(disturbed(T_map_keyframe, random, kSigmaM, kSigmaRad));
    T_map_keyframe = T_map_keyframe * step;
    if (i == 0) continue;
    const Pose2 measured = disturbed(step, random, kSigmaM, kSigmaRad);
    graph.factors.push_back({keyframe(i - 1), keyframe(i), measured, information});
    if (i < kLap || i % 4 != 0) continue;
    const Pose2 matched = disturbed(Pose2(), random, kSigmaM, kSigmaRad);
    graph.factors.push_back({keyframe(i - kLap), keyframe(i), matched, information, true});
  }
  return graph;
}

void pose_graph_solve(benchmark::State& state) {
  const BackendConfig config;
  const PoseGraph start = laps(static_cast<std::size_t>(state.range(0)));
  int steps = 0;
  while (state.KeepRunning()) {
    state.PauseTiming();
    PoseGraph graph = start;
    state.ResumeTiming();
    // A new one: each closure changes the pattern, which is then analysed anew.
    const Result<OptimizeReport> report =
        PoseGraphOptimizer(config.dcs_phi, config.optimizer_iterations).optimize(graph);
    SWIFTLET_CHECK(report, "the graph can be solved");
    steps += report->iterations;
  }
  state.SetComplexityN(state.range(0));
  state.counters["steps"] = benchmark::Counter(steps, benchmark::Counter::kAvgIterations);
}
BENCHMARK(pose_graph_solve)
    ->ArgName("poses")
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Arg(3000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

/// A flight of as many scans, lap after lap.
TestVehicle flight_of(std::size_t scans) {
  TestVehicle vehicle = vehicle_at_start({}, 11);
  while (vehicle.samples().size() < scans) fly_along(vehicle, loop_corridor(), "bcda");
  return vehicle;
}

/// Off in slow waves, as loop closing leaves a path.
std::vector<Pose2> in_waves(std::span<const RangeSample> samples) {
  std::vector<Pose2> path;
  for (const RangeSample& sample : samples) {
    const double phase = 2.0 * kPi * static_cast<double>(path.size()) / 150.0;
    const Pose2& T = sample.T_odom_body;
    path.emplace_back(T.x_m() + 0.1 * (1.0 - std::cos(phase)), T.y_m() + 0.1 * std::sin(1.3 * phase),
                      T.yaw_rad() + 0.02 * std::sin(0.7 * phase));
  }
  return path;
}

void refinement(benchmark::State& state) {
  const TestVehicle vehicle = flight_of(static_cast<std::size_t>(state.range(0)));
  const std::span samples = std::span(vehicle.samples()).first(static_cast<std::size_t>(state.range(0)));
  const StoredRun run(samples);
  const std::vector<Pose2> start = in_waves(samples);
  while (state.KeepRunning()) {
    std::vector<Pose2> T_map_body = start;
    const Result<RefinementReport> report =
        refine_in_turn({.scans = run.scans(), .sensor = SensorModel::crazyflie(), .config = {}}, T_map_body);
    SWIFTLET_CHECK(report, "the poses can be refined");
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(refinement)
    ->ArgName("poses")
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Arg(3000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace
}  // namespace swiftlet

BENCHMARK_MAIN();
