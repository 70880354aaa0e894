// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "daemon/workers/stage_times.hpp"

namespace swiftlet {

/// How a run kept time, as report.json or a status message reports it.
struct TimingReport {
  struct Queue {
    std::string name;
    std::uint64_t capacity = 0;
    std::uint64_t high_water = 0;
    std::uint64_t refused = 0;
  };
  std::vector<StageSummary> stages;          ///< those that ran
  std::vector<StageBuckets> buckets;         ///< of them; empty in a status message
  std::vector<Queue> queues;                 ///< empty where nobody published
  std::uint64_t missed_deadlines = 0;        ///< poses, of those in the stage "frame_to_pose"
  std::optional<double> pose_deadline_ms{};  ///< known from report.json of swiftletd only
};

/// Errors: kNotFound: no such file. kInvalidInput: it is no report.json, or of a version that did not keep
/// time.
[[nodiscard]] Result<TimingReport> read_timing_report(const std::filesystem::path& file);

}  // namespace swiftlet
