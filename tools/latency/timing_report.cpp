// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/timing_report.hpp"

#include <nlohmann/json.hpp>

#include "daemon/outputs/report_file.hpp"

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

void read_stages(const Json& json, TimingReport& report) {
  for (const auto& [name, figures] : json.at("stage_times").items()) {
    if (figures.at("count") == 0) continue;
    report.stages.push_back({.name = name,
                             .count = figures.at("count"),
                             .mean_ms = figures.at("mean_ms"),
                             .p50_ms = figures.at("p50_ms"),
                             .p99_ms = figures.at("p99_ms"),
                             .p999_ms = figures.at("p999_ms"),
                             .max_ms = figures.at("max_ms")});
    StageBuckets& buckets = report.buckets.emplace_back(StageBuckets{.name = name, .buckets = {}});
    for (const Json& bucket : json.at("histograms_ns").at(name))
      buckets.buckets.push_back({.upper_ns = bucket.at(0), .count = bucket.at(1)});
  }
}

TimingReport report_of(const Json& json) {
  TimingReport report;
  read_stages(json, report);
  if (json.contains("queues"))
    for (const auto& [name, queue] : json.at("queues").items())
      report.queues.push_back({name, queue.at("capacity"), queue.at("high_water"), queue.at("refused")});
  if (json.contains("pose_deadline")) {
    report.pose_deadline_ms = json.at("pose_deadline").at("ms").get<double>();
    report.missed_deadlines = json.at("pose_deadline").at("missed");
  }
  return report;
}

}  // namespace

Result<TimingReport> read_timing_report(const std::filesystem::path& file) {
  const Result<Json> json = read_report(file);
  if (!json) return json.error();
  try {
    if (!json->is_discarded()) return report_of(*json);
  } catch (const Json::exception&) {  // something is missing or of another type
  }
  return Error{ErrorCode::kInvalidInput,
               file.string() +
                   ": not a report.json with the times of a run; name one that swiftletd "
                   "-o or swiftlet map -o wrote"};
}

}  // namespace swiftlet
