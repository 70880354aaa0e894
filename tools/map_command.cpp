// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/map_command.hpp"

#include <chrono>
#include <cstdio>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

#include "daemon/outputs/map_notes.hpp"
#include "daemon/outputs/output_directory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "tools/command_end.hpp"
#include "tools/mapped_run.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {

namespace {

void print_summary(const OutputDirectory& output, const WrittenOutputs& outputs, const RunView& run) {
  for (const std::string& note : run.input.notes) print_note(note);
  const BackendCounters& counters = run.backend.counters();
  std::printf("%llu samples, %llu keyframes, %llu loop closures (%llu of them dropped), %zu input problems\n",
              static_cast<unsigned long long>(counters.scans),
              static_cast<unsigned long long>(counters.keyframes),
              static_cast<unsigned long long>(counters.closures_accepted),
              static_cast<unsigned long long>(counters.closures_dropped), run.input.problems.size());
  for (const std::string& note : map_notes(counters)) print_note(note);
  if (const auto note = replacement_note(output.path(), outputs)) print_note(*note);
  std::string files;
  for (const std::string& name : outputs.files) files += " " + name;
  std::printf("files: %s:%s\n", output.path().c_str(), files.c_str());
  if (const auto error = run_error(run))
    std::printf(
        "error before correction %.3f m, live %.3f m, after %.3f m (RMSE of %zu positions, aligned)\n",
        error->odometry.rmse_m, error->live.rmse_m, error->corrected.rmse_m, error->corrected.pairs);
  std::printf("picture: %s\n", (output.path() / "map.png").c_str());
}

Result<OutputDirectory> output_of(const MapCommand& command) {
  const HostTime now(std::chrono::system_clock::now().time_since_epoch());
  return OutputDirectory::of_run(command.output_directory, command.input, now);
}

/// The input is read as a whole to be calibrated.
Result<std::unique_ptr<MappedRun>> mapped(const MapCommand& command, const OutputDirectory& output,
                                          const std::stop_token& stop) {
  Result<PreparedRun> prepared = prepare_run(command, stop);
  if (!prepared) return prepared.error();
  return map_with_progress_bar(command, std::move(prepared).value(), output.path(), stop);
}

}  // namespace

Status run_map_command(const MapCommand& command) {
  const SignalWatcher signals;
  const Result<OutputDirectory> output = output_of(command);  // first: the rest takes time
  if (!output) return output.error();
  const Result<std::unique_ptr<MappedRun>> run = mapped(command, *output, signals.token());
  if (signals.token().stop_requested())
    return Error{ErrorCode::kTimeout, "mapping stopped before its end; nothing was written"};
  if (!run) return run.error();
  RunView view = (*run)->view();
  view.has_plan = command.plan;
  const Result<WrittenOutputs> written = write_run_outputs(output->path(), view);
  if (!written) return written.error();
  print_summary(*output, *written, view);
  return damage_of((*run)->report());
}

}  // namespace swiftlet
