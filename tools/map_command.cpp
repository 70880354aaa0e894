// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/map_command.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/peak_memory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "tools/calibration/input_calibration.hpp"
#include "tools/evaluation/live_observer.hpp"
#include "tools/prepared_run.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {

namespace {

/// To the end of the input, before the eyes of the observer if there is one. The report, with what ended the
/// input before its time among the problems.
InputReport run_to_end(Pipeline& pipeline, const SampleSource& source, LiveObserver* observer) {
  ProgressBar bar(stderr, ProgressBar::Clock::now());
  Result<bool> more = pipeline.step();
  while (more && *more) {
    if (observer != nullptr) observer->look();
    bar.update(source.progress(), ProgressBar::Clock::now());
    more = pipeline.step();
  }
  InputReport report = source.report();
  if (!more) {
    const std::string& reason = more.error().message;
    if (std::find(report.problems.begin(), report.problems.end(), reason) == report.problems.end())
      report.problems.push_back(reason);
  }
  return report;
}

void print_summary(const MapCommand& command, const RunView& run) {
  for (const std::string& note : run.input.notes) std::fprintf(stderr, "swiftlet: note: %s\n", note.c_str());
  const BackendCounters& counters = run.backend.counters();
  std::printf("%llu samples, %llu keyframes, %llu loop closures (%llu of them dropped), %zu input problems\n",
              static_cast<unsigned long long>(counters.scans),
              static_cast<unsigned long long>(counters.keyframes),
              static_cast<unsigned long long>(counters.closures_accepted),
              static_cast<unsigned long long>(counters.closures_dropped), run.input.problems.size());
  if (counters.map_source != MapSource::kPoseGraph)
    std::fprintf(stderr,
                 "swiftlet: note: the map follows %s alone, which explains the ranges no worse than loop "
                 "closures do\n",
                 std::string(name_of(counters.map_source)).c_str());
  const std::string directory = command.output_directory.string();
  std::printf("files: %s: map.png map.pgm map.yaml trajectory.tum odometry.tum live.tum %sreport.json\n",
              directory.c_str(), run.truth.empty() ? "" : "ground_truth.tum ");
  if (const auto error = run_error(run))
    std::printf(
        "error before correction %.3f m, live %.3f m, after %.3f m (RMSE of %zu positions, aligned)\n",
        error->odometry.rmse_m, error->live.rmse_m, error->corrected.rmse_m, error->corrected.pairs);
  std::printf("picture: %s\n", (command.output_directory / "map.png").c_str());
}

/// All that was wrong with the input, in the one line that main prints.
Status damage_of(const InputReport& report) {
  if (report.problems.empty()) return {};
  std::string message = report.problems.front();
  for (std::size_t i = 1; i < report.problems.size(); ++i) message += "; " + report.problems[i];
  return Error{ErrorCode::kDamaged, message + "; the outputs hold what came before"};
}

bool is_simulation(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  return uri && uri->is(InputNature::kSimulation);
}

}  // namespace

Status run_map_command(const MapCommand& command) {
  Result<PreparedRun> prepared = prepare_run(command);
  if (!prepared) return prepared.error();
  SampleSource& source = *prepared->source;
  const Configuration& config = prepared->config;
  const std::optional<InputCalibration>& calibration = prepared->calibration;
  if (Status ready = prepare_output_directory(command.output_directory); !ready) return ready;

  Result<PrunedScans> pruned = PrunedScans::open(command.output_directory);
  if (!pruned) return pruned.error();
  Pipeline pipeline(config, source);
  pipeline.keep_pruned(*pruned);
  std::optional<LiveObserver> observer;
  if (is_simulation(command.input)) observer.emplace(pipeline.backend());
  InputReport report = run_to_end(pipeline, source, observer ? &*observer : nullptr);
  if (calibration) report.notes.push_back(calibration_note(*calibration));
  if (Status usable = check_usable(command, report, pipeline.backend()); !usable) return usable;
  const double peak_of_run_mb = peak_memory_mb();  // before the outputs take their room
  std::vector<StampedPose> truth = source.ground_truth();
  std::optional<KnownPlaceError> known_places;
  if (observer) known_places = observer->error(StampedPath(truth));
  const RunView run{.backend = pipeline.backend(),
                    .map = pipeline.map(),
                    .input = report,
                    .frontend = pipeline.frontend().counters(),
                    .timing = pipeline.timing(),
                    .truth = std::move(truth),
                    .input_uri = command.input,
                    .sensor = config.sensor.applied_to(source.sensor()),
                    .calibration = calibration,
                    .mended = source.mended(),
                    .pruned = &*pruned,
                    .known_places = known_places,
                    .peak_memory_mb = peak_of_run_mb};
  if (Status written = write_run_outputs(command.output_directory, run); !written) return written;
  print_summary(command, run);
  return damage_of(report);
}

}  // namespace swiftlet
