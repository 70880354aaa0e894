// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "tools/latency/timing_report.hpp"

namespace swiftlet {

/// A run of a thousand poses at 0.1 ms, one of them at 5 ms.
inline TimingReport late_once() {
  return {
      .stages = {{.name = "frame_to_pose",
                  .count = 1000,
                  .mean_ms = 0.105,
                  .p50_ms = 0.1,
                  .p99_ms = 0.1,
                  .p999_ms = 0.1,
                  .max_ms = 5.0}},
      .buckets = {{.name = "frame_to_pose",
                   .buckets = {{.upper_ns = 100'000, .count = 999}, {.upper_ns = 5'000'000, .count = 1}}}},
      .queues = {{"poses", 256, 3, 0}},
      .missed_deadlines = 1,
      .pose_deadline_ms = 2.0};
}

}  // namespace swiftlet
