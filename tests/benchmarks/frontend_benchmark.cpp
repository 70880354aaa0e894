// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// The frontend's costly steps, on drives around a ring of corridors.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/check.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/frontend/landmark_graph_solver.hpp"
#include "core/frontend/line_extractor.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/multiscan.hpp"
#include "tests/core/frontend/room_drive.hpp"

namespace swiftlet {
namespace {

// The frontend's own.
constexpr LandmarkGraphCapacity kCapacity{kMaxKeyframeWindow, 128, 1024};
using Graph = LandmarkGraph<kCapacity>;
using Solver = LandmarkGraphSolver<kCapacity>;

/// Four beams all around, or as many as are asked for over the front half, as laser logs are thinned.
BeamLayout layout_of(int beams) {
  if (beams == 4) return BeamLayout::multiranger();
  BeamLayout layout;
  layout.count = static_cast<std::uint8_t>(beams);
  for (int i = 0; i < beams; ++i)
    layout.bearing_rad[static_cast<std::size_t>(i)] = kPi * (static_cast<double>(i) / (beams - 1) - 0.5);
  return layout;
}

/// What the extractor is given at the keyframes of a lap.
std::vector<MultiscanView> views_of_a_lap(const FrontendConfig& config, const BeamLayout& beams,
                                          const SensorModel& sensor) {
  constexpr std::size_t kSamplesPerKeyframe = 12;
  const test::RoomDrive drive = test::drive_around(1, beams, sensor, {}, 1);
  Multiscan multiscan(sensor, beams, static_cast<std::size_t>(config.multiscan_points));
  std::vector<MultiscanView> views;
  for (std::size_t i = 0; i < drive.samples.size(); ++i) {
    const Pose2 step =
        i == 0 ? Pose2() : between(drive.samples[i - 1].T_odom_body, drive.samples[i].T_odom_body);
    multiscan.add(drive.samples[i], uncertain_step(sensor.odometry, step, std::chrono::milliseconds(100)));
    if (i % kSamplesPerKeyframe == kSamplesPerKeyframe - 1) multiscan.assemble(views.emplace_back());
  }
  return views;
}

void line_extraction(benchmark::State& state) {
  const FrontendConfig config;
  const SensorModel sensor = state.range(0) == 4 ? SensorModel::crazyflie() : SensorModel::carmen_laser();
  const std::vector<MultiscanView> views =
      views_of_a_lap(config, layout_of(static_cast<int>(state.range(0))), sensor);
  const auto extractor = std::make_unique<LineExtractor>(config, sensor.range_sigma_m);
  LineSegments segments;
  std::size_t next = 0;
  std::size_t lines = 0;
  while (state.KeepRunning()) {
    static_cast<void>(extractor->extract(views[next], segments));
    lines += segments.size();
    next = (next + 1) % views.size();
  }
  state.counters["lines"] =
      benchmark::Counter(static_cast<double>(lines), benchmark::Counter::kAvgIterations);
}
BENCHMARK(line_extraction)->ArgName("beams")->Arg(4)->Arg(11)->Arg(60);

/// The line through a wall as seen from a pose, unless it is out of range.
std::optional<LineSegment> seen_from(const Pose2& T_room_body, const test::RoomWall& wall,
                                     test::RandomGeometry& random) {
  constexpr double kRangeM = 3.0;
  constexpr double kSigma = 0.02;  // metres or radians
  const double along_rad = bearing_rad(wall.start, wall.end);
  const double alpha_rad = along_rad + 0.5 * kPi;
  const Line2 in_room{wall.start.x_m * std::cos(alpha_rad) + wall.start.y_m * std::sin(alpha_rad), alpha_rad};
  LineSegment segment;
  segment.line = transform_line(T_room_body.inverse(), in_room).line_b;
  if (std::abs(segment.line.rho_m) > kRangeM) return std::nullopt;
  segment.line.rho_m += random.normal(kSigma);
  segment.line.alpha_rad += random.normal(kSigma);
  segment.covariance = Eigen::Vector2d(kSigma * kSigma, kSigma * kSigma).asDiagonal();
  segment.start = T_room_body.inverse() * wall.start;
  segment.end = T_room_body.inverse() * wall.end;
  return segment;
}

/// Keyframes every half a metre around the ring, each with all walls in range.
std::unique_ptr<Graph> graph_of(std::size_t poses) {
  constexpr std::size_t kSamplesPerKeyframe = 13;
  const SensorModel sensor = SensorModel::crazyflie();
  const test::RoomDrive drive = test::drive_around(1, BeamLayout::multiranger(), sensor, {}, 2);
  const std::vector<test::RoomWall> walls = test::ring_of_corridors();
  std::vector<std::optional<std::size_t>> landmark_of(walls.size());
  test::RandomGeometry random(3);
  auto graph = std::make_unique<Graph>();
  for (std::size_t k = 0; k < poses; ++k) {
    const std::size_t at = k * kSamplesPerKeyframe;
    const KeyframeId id{static_cast<std::uint32_t>(k)};
    if (k == 0) {
      graph->add_first_pose(id, drive.T_room_body[0]);
    } else {
      const Pose2 step =
          between(drive.samples[at - kSamplesPerKeyframe].T_odom_body, drive.samples[at].T_odom_body);
      SWIFTLET_CHECK(
          graph->try_add_pose(id, uncertain_step(sensor.odometry, step, std::chrono::milliseconds(100))),
          "the graph has room");
    }
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const std::optional<LineSegment> segment = seen_from(drive.T_room_body[at], walls[w], random);
      if (!segment) continue;
      const bool is_new = !landmark_of[w];
      if (is_new) landmark_of[w] = graph->landmarks().size();
      const bool added = is_new ? graph->try_add_landmark(LandmarkId{static_cast<std::uint32_t>(w)}, *segment)
                                : graph->try_observe(*landmark_of[w], *segment);
      SWIFTLET_CHECK(added, "the graph has room");
    }
  }
  return graph;
}

void landmark_graph_solve(benchmark::State& state) {
  const std::unique_ptr<Graph> start = graph_of(static_cast<std::size_t>(state.range(0)));
  const auto graph = std::make_unique<Graph>(*start);
  const auto solver = std::make_unique<Solver>();
  int steps = 0;
  while (state.KeepRunning()) {
    state.PauseTiming();
    *graph = *start;
    state.ResumeTiming();
    steps += solver->optimize(*graph, FrontendConfig{}.solver_iterations).steps;
  }
  state.SetComplexityN(state.range(0));
  state.counters["steps"] = benchmark::Counter(steps, benchmark::Counter::kAvgIterations);
  state.counters["observations"] = static_cast<double>(start->observations().size());
}
// From the fixed lag's beginning over its default to the most it can be set to.
BENCHMARK(landmark_graph_solve)->ArgName("poses")->Arg(6)->Arg(12)->Arg(24)->Arg(48)->Arg(64)->Complexity();

}  // namespace
}  // namespace swiftlet

BENCHMARK_MAIN();
