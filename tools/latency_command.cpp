// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency_command.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/png_file.hpp"
#include "daemon/publish/decoded_message.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "swiftlet/status_t.hpp"
#include "tools/latency/latency_picture.hpp"
#include "tools/latency/latency_table.hpp"
#include "tools/latency/timing_report.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

Status show_report(const LatencyCommand& command) {
  if (!command.picture_file.empty())
    if (Status usable = check_output_file(command.picture_file, std::array{fs::path(command.report_file)});
        !usable)
      return usable;
  const Result<TimingReport> report = read_timing_report(command.report_file);
  if (!report) return report.error();
  std::fputs(latency_table(*report).c_str(), stdout);
  if (command.picture_file.empty()) return {};
  const Result<std::string> png = encode_png(draw_latencies(*report));
  if (!png) return png.error();
  if (Status written = write_file(command.picture_file, *png); !written) return written;
  std::printf("picture: %s\n", command.picture_file.c_str());
  return {};
}

TimingReport report_of(const status_t& status) {
  TimingReport report;
  for (const stage_time_t& stage : status.stages) {
    if (stage.count > 0)
      report.stages.push_back({.name = stage.name,
                               .count = static_cast<std::uint64_t>(stage.count),
                               .mean_ms = stage.mean,
                               .p50_ms = stage.p50,
                               .p99_ms = stage.p99,
                               .p999_ms = stage.p999,
                               .max_ms = stage.max});
  }
  for (const queue_status_t& queue : status.queues)
    report.queues.push_back({queue.name, static_cast<std::uint64_t>(queue.capacity),
                             static_cast<std::uint64_t>(queue.high_water),
                             static_cast<std::uint64_t>(queue.refused)});
  report.missed_deadlines = static_cast<std::uint64_t>(status.missed_deadlines);
  return report;
}

Status listen(const LatencyCommand& command) {
  const SignalWatcher signals;
  const Result<std::unique_ptr<LcmTransport>> lcm = LcmTransport::open(command.lcm_url);
  if (!lcm) return lcm.error();
  bool is_over = false;
  (*lcm)->listen(command.channel_prefix + "STATUS", [&is_over](std::span<const std::uint8_t> bytes) {
    const std::optional<status_t> status = decoded_message<status_t>(bytes);
    if (!status) return;
    std::printf("%s\n", latency_table(report_of(*status)).c_str());
    std::fflush(stdout);
    is_over = status->state == status_t::STATE_FINISHED;
  });
  while (!is_over && !(*lcm)->has_ended() && !signals.token().stop_requested())
    (*lcm)->receive(std::chrono::milliseconds(100));
  return {};
}

}  // namespace

Status run_latency_command(const LatencyCommand& command) {
  if (command.listen == !command.report_file.empty())
    return Error{ErrorCode::kInvalidInput, "latency: name a report.json, or --listen to a running swiftletd"};
  if (command.listen && !command.picture_file.empty())
    return Error{ErrorCode::kInvalidInput,
                 "latency: a picture needs a report.json; statuses hold no histograms"};
  return command.listen ? listen(command) : show_report(command);
}

}  // namespace swiftlet
