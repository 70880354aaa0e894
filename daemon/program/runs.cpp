// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/program/runs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/commands/command_executor.hpp"
#include "daemon/daemon.hpp"
#include "daemon/outputs/map_notes.hpp"
#include "daemon/outputs/peak_memory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/program/run_parts.hpp"
#include "daemon/system/service_manager.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kSleep{100};
constexpr int kSleepsBetweenTries = 10;

/// A live link keeps its own pace and cannot be asked to wait; a recording that is still written does and
/// can.
InputPolicy input_policy(const Options& options, const SampleSource& source) {
  if (source.is_live()) return {.rate = {}, .refuses_when_full = true};
  if (is_followed(options)) return {.rate = {}};
  return {.rate = options.rate};
}

std::string input_text(const Options& options, const SampleSource& source) {
  if (source.is_live() || is_followed(options)) return options.input_uri + " (until stopped by a signal)";
  return fmt::format("{} at {} times its pace", options.input_uri, options.rate);
}

/// One line for each problem of the input, and for each note from `first_note` on; its exit code.
int log_problems(const Options& options, const Daemon& daemon, const InputReport& report,
                 std::size_t first_note, const Status& outcome) {
  int exit_code = 0;
  for (std::size_t i = first_note; i < report.notes.size(); ++i) spdlog::info("{}", report.notes[i]);
  for (const std::string& problem : report.problems) exit_code = refuse(problem);
  if (!outcome) exit_code = refuse(outcome.error().message);
  if (daemon.pipeline().backend().scans().size() == 0 && exit_code == 0)
    exit_code = refuse(options.input_uri + ": held no usable sample");
  return exit_code;
}

Status write_outputs(const Outputs* outputs, const Options& options, const Configuration& config,
                     const Daemon& daemon, const SampleSource& source,
                     const std::vector<MarkedPlace>& places) {
  if (outputs == nullptr || daemon.pipeline().backend().scans().size() == 0) return {};
  const std::filesystem::path& directory = outputs->directory.path();
  spdlog::info("writing {}", directory.string());
  const Result<WrittenOutputs> written =
      write_run_outputs(directory, {.backend = daemon.pipeline().backend(),
                                    .map = daemon.pipeline().map(),
                                    .input = source.report(),
                                    .frontend = daemon.pipeline().frontend().counters(),
                                    .timing = daemon.pipeline().timing(),
                                    .truth = source.ground_truth(),
                                    .input_uri = options.input_uri,
                                    .sensor = config.sensor.applied_to(source.sensor()),
                                    .mended = source.mended(),
                                    .pruned = &outputs->pruned,
                                    .places = places,
                                    .peak_memory_mb = peak_memory_mb()});
  if (!written) return written.error();
  if (const auto note = replacement_note(directory, *written)) spdlog::info("{}", *note);
  return {};
}

/// Until the recording is on the disk, too.
Status run_recorded(Daemon& daemon, Recorder* recorder, const std::stop_token& stop) {
  std::optional<RecorderThread> thread;
  if (recorder != nullptr) {
    spdlog::info("recording to {}", recorder->path());
    thread.emplace(*recorder);
    daemon.report_recording([recorder] {
      return RecordingFigures{recorder->failed() ? RecordingState::kFailed : RecordingState::kRunning,
                              recorder->bytes()};
    });
  }
  return daemon.run(stop);
}

/// What becomes of commands; `over` ends the run.
CommandExecutor make_executor(const RunParts& run, Daemon& daemon, std::stop_source& over) {
  CommandExecutor::Run of_commands{.directory = {},
                                   .is_live = run.source->is_live(),
                                   .has_client = [&daemon] { return daemon.has_client(); },
                                   .end =
                                       [&] {
                                         daemon.announce_next_run();
                                         over.request_stop();
                                       }};
  if (run.outputs) of_commands.directory = run.outputs->directory.path();
  return CommandExecutor(std::move(of_commands));
}

/// How a run ended.
struct RunEnd {
  int exit_code = 0;
  bool wants_new_map = false;
};

/// Writes down what is left of the run when its threads have ended.
int finish_run(const Options& options, const Configuration& config, const RunParts& run, const Daemon& daemon,
               const std::vector<MarkedPlace>& places, const Status& outcome) {
  const BackendCounters& counters = daemon.pipeline().backend().counters();
  spdlog::info("{} samples, {} keyframes, {} loop closures ({} of them dropped)", counters.scans,
               counters.keyframes, counters.closures_accepted, counters.closures_dropped);
  for (const std::string& note : map_notes(counters)) spdlog::info("{}", note);
  const Status written = write_outputs(run.outputs.get(), options, config, daemon, *run.source, places);
  // A live vehicle's notes are the events that were logged when they happened.
  const InputReport& report = run.source->report();
  const std::size_t first_note = run.source->is_live() ? report.notes.size() : 0;
  int exit_code = log_problems(options, daemon, report, first_note, outcome);
  for (const Status& kept : {written, run.lcm->check_log()})
    if (!kept) exit_code = refuse(kept.error().message);
  return exit_code;
}

RunEnd run_once(const Options& options, const Configuration& config, const RunParts& run,
                const ServiceManager& service_manager, const std::stop_token& signalled) {
  SteadyClock clock;
  Daemon daemon(config, *run.source, clock, input_policy(options, *run.source), *run.publisher);
  if (run.outputs) daemon.keep_pruned(run.outputs->pruned);
  spdlog::info("{}, publishing on {}", input_text(options, *run.source), options.lcm_url);
  daemon.report_to(service_manager);
  std::stop_source over;
  const std::stop_callback at_signal(signalled, [&over] {
    spdlog::info("stopped by a signal: the map is finished first; a second signal would lose it");
    over.request_stop();
  });
  CommandExecutor executor = make_executor(run, daemon, over);
  daemon.execute_commands_by(
      [&executor](const Command& command, const MapBuilder& map, std::optional<HostTime> newest) {
        executor.execute(command, map, newest);
      });
  if (run.commands)
    run.commands->start([&daemon](const Command& command) { return daemon.command(command); });
  const Status outcome = run_recorded(daemon, run.recorder.get(), over.get_token());
  if (run.commands) run.commands->stop();
  daemon.execute_late_commands();
  service_manager.feed_watchdog();
  return {.exit_code = finish_run(options, config, run, daemon, executor.places(), outcome),
          .wants_new_map = executor.wants_new_map()};
}

/// The flight goes on, and so does the daemon: what cannot be opened is told once, and tried again. nullptr:
/// the daemon is to end, and a run that no sample reaches would take the finished map from its consumers.
std::unique_ptr<RunParts> open_in_flight(const Options& options, const Configuration& config,
                                         const ServiceManager& service_manager,
                                         const std::stop_token& signalled) {
  std::string told;
  while (!signalled.stop_requested()) {
    service_manager.feed_watchdog();
    Result<std::unique_ptr<RunParts>> opened = RunParts::open(options, config);
    if (signalled.stop_requested()) break;
    if (opened) return std::move(opened).value();
    const std::string& why = opened.error().message;
    if (why != told) spdlog::warn("the next run cannot begin: {}; it is tried again", why);
    told = why;
    for (int i = 0; i < kSleepsBetweenTries && !signalled.stop_requested(); ++i)
      std::this_thread::sleep_for(kSleep);
  }
  return nullptr;
}

}  // namespace

int run_until_over(const Options& options, const Configuration& config, const std::stop_token& signalled) {
  const ServiceManager service_manager;
  int exit_code = 0;  // the worst of all runs
  Options of_run = options;
  Result<std::unique_ptr<RunParts>> first = RunParts::open(of_run, config);
  if (!first) return refuse(first.error().message);
  std::unique_ptr<RunParts> run = std::move(first).value();
  for (int number = 2; run != nullptr; ++number) {
    const RunEnd end = run_once(of_run, config, *run, service_manager, signalled);
    exit_code = std::max(exit_code, end.exit_code);
    if (!end.wants_new_map) break;
    run.reset();
    reset_peak_memory();
    of_run = options_of_run(options, number);
    run = open_in_flight(of_run, config, service_manager, signalled);
  }
  return exit_code;
}

}  // namespace swiftlet
