// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <vector>

#include "daemon/outputs/run_outputs.hpp"
#include "tests/core/mapping/room_flight.hpp"

namespace swiftlet {

/// A flight of 81 samples through a room, drawn, with a truth of which the odometry knows nothing: every step
/// was a tenth longer than odometry measured.
struct FinishedRun {
  /// From `first_above` on, the flight is on the next storey. Sample `late` is stamped a quarter of a second
  /// late, behind the two that follow it.
  explicit FinishedRun(int samples = 81, int first_above = 1000, int late = -1) {
    for (FrontendStep step : room_flight(samples)) {
      if (static_cast<int>(step.sample.sequence) >= first_above) step.sample.storey = StoreyId{1};
      if (static_cast<int>(step.sample.sequence) == late) step.sample.stamp += std::chrono::milliseconds(250);
      backend.add(step);
      map.update(backend, false);
      truth.push_back({step.sample.stamp, Pose2(1.1 * step.sample.T_odom_body.x_m(), 0.0, 0.0)});
    }
    input.counters.samples = static_cast<std::uint64_t>(samples);
    input.notes = {"a note"};
    input.problems = {"damaged at byte 123"};
    frontend.keyframes = 17;
  }
  [[nodiscard]] RunView view(bool with_truth) const {
    return {.backend = backend,
            .map = map,
            .input = input,
            .frontend = frontend,
            .timing = timing,
            .truth = with_truth ? truth : std::vector<StampedPose>{},
            .input_uri = "sim://room",
            .sensor = SensorModel::crazyflie(),
            .peak_memory_mb = 12.5};
  }

  Backend backend{without_loops(), SensorModel::crazyflie(), BeamLayout::multiranger()};
  MapBuilder map{MapConfig{}, SensorModel::crazyflie()};
  InputReport input;
  RunTiming timing{
      .stages = {{.name = "frontend",
                  .count = 81,
                  .mean_ms = 0.1,
                  .p50_ms = 0.09,
                  .p99_ms = 0.4,
                  .p999_ms = 0.45,
                  .max_ms = 0.5}},
      .buckets = {{.name = "frontend",
                   .buckets = {{.upper_ns = 90'111, .count = 80}, {.upper_ns = 507'903, .count = 1}}}},
      .queues = {},
      .pose_deadline = std::chrono::milliseconds(2),
      .missed_deadlines = 0};
  FrontendCounters frontend;
  std::vector<StampedPose> truth;
};

}  // namespace swiftlet
