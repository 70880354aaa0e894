// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/time.hpp"
#include "daemon/workers/stage_times.hpp"

namespace swiftlet {

/// What a queue has seen since the start.
struct QueueStatistics {
  std::string_view name;
  std::size_t capacity = 0;
  std::uint64_t high_water = 0;  ///< the most items that ever waited
  std::uint64_t refused = 0;     ///< items there was no room for
};

/// How a run kept time.
struct RunTiming {
  std::vector<StageSummary> stages;
  std::vector<StageBuckets> buckets;    ///< of the same stages, in the same order
  std::vector<QueueStatistics> queues;  ///< empty where nobody publishes
  Duration pose_deadline{};
  std::uint64_t missed_deadlines = 0;  ///< poses that took longer from radio frame to publication
};

}  // namespace swiftlet
