// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/latency_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace swiftlet {
namespace {

std::string deadline_line(const TimingReport& report) {
  const auto poses = std::find_if(report.stages.begin(), report.stages.end(),
                                  [](const StageSummary& stage) { return stage.name == "frame_to_pose"; });
  if (poses == report.stages.end()) return "no pose was published\n";
  const std::string deadline = report.pose_deadline_ms
                                   ? fmt::format("the deadline of {:g} ms", *report.pose_deadline_ms)
                                   : "their deadline";
  return fmt::format("{} of {} poses missed {}\n", report.missed_deadlines, poses->count, deadline);
}

}  // namespace

std::string latency_table(const TimingReport& report) {
  std::string text = fmt::format("{:<14}{:>9}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "ms", "count", "mean", "p50",
                                 "p99", "p99.9", "max");
  for (const StageSummary& stage : report.stages)
    text += fmt::format("{:<14}{:>9}{:>11.4f}{:>11.4f}{:>11.4f}{:>11.4f}{:>11.4f}\n", stage.name, stage.count,
                        stage.mean_ms, stage.p50_ms, stage.p99_ms, stage.p999_ms, stage.max_ms);
  if (!report.queues.empty())
    text += fmt::format("\n{:<14}{:>9}{:>11}{:>11}\n", "queue", "capacity", "high water", "refused");
  for (const TimingReport::Queue& queue : report.queues)
    text +=
        fmt::format("{:<14}{:>9}{:>11}{:>11}\n", queue.name, queue.capacity, queue.high_water, queue.refused);
  return text + "\n" + deadline_line(report);
}

}  // namespace swiftlet
