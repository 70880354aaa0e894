// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/map_command.hpp"

#include <chrono>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>

#include "daemon/outputs/output_directory.hpp"
#include "daemon/outputs/peak_memory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "tools/calibration/input_calibration.hpp"
#include "tools/evaluation/live_observer.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {

namespace {

void print_summary(const OutputDirectory& output, const WrittenOutputs& outputs, const RunView& run) {
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
  if (const auto note = replacement_note(output.path(), outputs))
    std::fprintf(stderr, "swiftlet: note: %s\n", note->c_str());
  std::string files;
  for (const std::string& name : outputs.files) files += " " + name;
  std::printf("files: %s:%s\n", output.path().c_str(), files.c_str());
  if (const auto error = run_error(run))
    std::printf(
        "error before correction %.3f m, live %.3f m, after %.3f m (RMSE of %zu positions, aligned)\n",
        error->odometry.rmse_m, error->live.rmse_m, error->corrected.rmse_m, error->corrected.pairs);
  std::printf("picture: %s\n", (output.path() / "map.png").c_str());
}

bool is_simulation(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  return uri && uri->is(InputNature::kSimulation);
}

Result<OutputDirectory> output_of(const MapCommand& command) {
  const HostTime now(std::chrono::system_clock::now().time_since_epoch());
  return OutputDirectory::of_run(command.output_directory, command.input, now);
}

/// What was published on the way, against the truth; nothing without an observer.
struct LiveFigures {
  std::optional<KnownPlaceError> known_places;
  std::optional<RunConsistency> consistency;
};
LiveFigures figures_of(const std::optional<LiveObserver>& observer, const std::vector<StampedPose>& truth) {
  if (!observer) return {};
  const StampedPath T_world_body(truth);
  const KnownPlaceError error = observer->error(T_world_body);
  const std::span<const DoubtedPose> poses = observer->doubted_poses();
  return {error, RunConsistency{consistency(poses, T_world_body), count_alarms(poses, error.errors)}};
}

}  // namespace

Status run_map_command(const MapCommand& command) {
  Result<PreparedRun> prepared = prepare_run(command);
  if (!prepared) return prepared.error();
  SampleSource& source = *prepared->source;
  const Configuration& config = prepared->config;
  const Result<OutputDirectory> output = output_of(command);
  if (!output) return output.error();

  Result<PrunedScans> pruned = PrunedScans::open(output->path());
  if (!pruned) return pruned.error();
  Pipeline pipeline(config, source);
  pipeline.keep_pruned(*pruned);
  std::optional<LiveObserver> observer;
  if (is_simulation(command.input)) observer.emplace(pipeline.backend());
  InputReport report = run_to_end(pipeline, source, [&observer] {
    if (observer) observer->look();
  });
  if (prepared->calibration) report.notes.push_back(calibration_note(*prepared->calibration));
  if (Status usable = check_usable(command, report, pipeline.backend()); !usable) return usable;
  const double peak_of_run_mb = peak_memory_mb();  // before the outputs take their room
  std::vector<StampedPose> truth = source.ground_truth();
  const LiveFigures live = figures_of(observer, truth);
  const RunView run{.backend = pipeline.backend(),
                    .map = pipeline.map(),
                    .input = report,
                    .frontend = pipeline.frontend().counters(),
                    .timing = pipeline.timing(),
                    .truth = std::move(truth),
                    .input_uri = command.input,
                    .sensor = config.sensor.applied_to(source.sensor()),
                    .calibration = prepared->calibration,
                    .mended = source.mended(),
                    .pruned = &*pruned,
                    .known_places = live.known_places,
                    .consistency = live.consistency,
                    .peak_memory_mb = peak_of_run_mb};
  const Result<WrittenOutputs> written = write_run_outputs(output->path(), run);
  if (!written) return written.error();
  print_summary(*output, *written, run);
  return damage_of(report);
}

}  // namespace swiftlet
