// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/map_command.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "daemon/config/configuration.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/peak_memory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/sample/sign_mending_source.hpp"
#include "tools/calibration/input_calibration.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {

namespace {

Result<Configuration> configuration_for(const MapCommand& command) {
  Configuration config;
  if (!command.config_file.empty()) {
    Result<Configuration> loaded = load_configuration(command.config_file);
    if (!loaded) return loaded;
    config = std::move(loaded).value();
  }
  if (command.odometry_only) config.frontend.use_landmarks = false;
  if (command.odometry_only || command.frontend_only) config.backend.close_loops = false;
  return config;
}

Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command, const Configuration& config) {
  SampleSourceOptions options;
  options.beam_count = command.beams;
  options.max_range_m = config.sensor.max_range_m;
  options.min_range_m = config.sensor.min_range_m;
  if (config.sensor.range_age_s) options.range_age = from_seconds(*config.sensor.range_age_s);
  Result<std::unique_ptr<SampleSource>> source = open_sample_source(command.input, options);
  if (!source || (*source)->is_live() || command.odometry_only) return source;
  return std::unique_ptr<SampleSource>(std::make_unique<SignMendingSource>(std::move(source).value()));
}

/// Estimates the systematic errors of the input from all of it first, and sets those that the configuration
/// leaves out.
std::optional<InputCalibration> calibrate_first(SampleSource& source, Configuration& config) {
  const Result<InputCalibration> calibration =
      calibrate_by_itself(source, config.sensor.applied_to(source.sensor()));
  if (!calibration) return std::nullopt;
  config.sensor.take_calibration(calibration->found);
  return *calibration;
}

/// To the end of the input. The report, with what ended the input before its time among the problems.
InputReport run_to_end(Pipeline& pipeline, const SampleSource& source) {
  ProgressBar bar(stderr, ProgressBar::Clock::now());
  Result<bool> more = pipeline.step();
  while (more && *more) {
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

Status check_usable(const MapCommand& command, const InputReport& report, const Backend& backend) {
  if (backend.scans().size() > 0) return {};
  const std::string reason =
      report.problems.empty() ? "it ended before the first one" : report.problems.front();
  return Error{ErrorCode::kInvalidInput, command.input + " holds no usable sample: " + reason};
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

}  // namespace

Status run_map_command(const MapCommand& command) {
  Result<Configuration> config = configuration_for(command);
  if (!config) return config.error();
  Result<std::unique_ptr<SampleSource>> opened = open_input(command, *config);
  if (!opened) return opened.error();
  std::optional<InputCalibration> calibration;
  if (command.calibrate && !command.odometry_only && !(*opened)->is_live()) {
    calibration = calibrate_first(**opened, *config);
    opened = open_input(command, *config);
    if (!opened) return opened.error();
  }
  SampleSource& source = **opened;
  if (Status ready = prepare_output_directory(command.output_directory); !ready) return ready;

  Result<PrunedScans> pruned = PrunedScans::open(command.output_directory);
  if (!pruned) return pruned.error();
  Pipeline pipeline(*config, source);
  pipeline.keep_pruned(*pruned);
  InputReport report = run_to_end(pipeline, source);
  if (calibration) report.notes.push_back(calibration_note(*calibration));
  if (Status usable = check_usable(command, report, pipeline.backend()); !usable) return usable;
  const double peak_of_run_mb = peak_memory_mb();  // before the outputs take their room
  const RunView run{.backend = pipeline.backend(),
                    .map = pipeline.map(),
                    .input = report,
                    .frontend = pipeline.frontend().counters(),
                    .timing = pipeline.timing(),
                    .truth = source.ground_truth(),
                    .input_uri = command.input,
                    .sensor = config->sensor.applied_to(source.sensor()),
                    .calibration = calibration,
                    .mended = source.mended(),
                    .pruned = &*pruned,
                    .peak_memory_mb = peak_of_run_mb};
  if (Status written = write_run_outputs(command.output_directory, run); !written) return written;
  print_summary(command, run);
  return damage_of(report);
}

}  // namespace swiftlet
