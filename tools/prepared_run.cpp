// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/prepared_run.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/sensing/lost_sign.hpp"
#include "daemon/workers/pipeline.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/sample/sign_mending_source.hpp"
#include "tools/calibration/input_calibration.hpp"

namespace swiftlet {

namespace {

Status check_has_an_end(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  if (!uri || !uri->is(InputNature::kVehicle)) return {};
  return Error{ErrorCode::kInvalidInput, input + ": a live vehicle has no end; map it with swiftletd " +
                                             input + ", or record it first: swiftlet record " + input +
                                             " -o flight.pcap"};
}

Result<Configuration> configuration_for(const MapCommand& command) {
  Result<Configuration> config = load_configuration(command.config_file, command.settings);
  if (!config) return config;
  if (command.odometry_only) config->frontend.use_landmarks = false;
  if (command.odometry_only || command.frontend_only) config->backend.close_loops = false;
  return config;
}

std::optional<Duration> range_age_of(const Configuration& config) {
  if (!config.sensor.range_age_s) return std::nullopt;
  return from_seconds(*config.sensor.range_age_s);
}

/// Estimates the systematic errors of the input from all of it first, and sets those that the configuration
/// leaves out.
std::optional<InputCalibration> calibrate_first(SampleSource& source, Configuration& config,
                                                const std::stop_token& stop) {
  const Result<InputCalibration> calibration =
      calibrate_by_itself(source, config.sensor.applied_to(source.sensor()), stop);
  if (!calibration) return std::nullopt;
  config.sensor.take_calibration(calibration->found);
  return *calibration;
}

std::unique_ptr<SampleSource> with_signs(std::unique_ptr<SampleSource> source, LostSigns signs) {
  if (signs == LostSigns::kAsReported) return source;
  const LostSignTuning tuning =
      signs == LostSigns::kMendedIfLikely ? LostSignTuning::for_a_trial() : LostSignTuning{};
  return std::make_unique<SignMendingSource>(std::move(source), tuning);
}

Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command, const Configuration& config,
                                                 LostSigns signs) {
  SampleSourceOptions options;
  options.beam_count = command.beams;
  options.max_range_m = config.sensor.max_range_m;
  options.min_range_m = config.sensor.min_range_m;
  options.range_age = range_age_of(config);
  options.mends_motion = !command.odometry_only;
  Result<std::unique_ptr<SampleSource>> source = open_sample_source(command.input, options);
  if (!source) return source;
  return with_signs(std::move(source).value(), signs);
}

/// From its beginning, with the settings that have been found since.
Status reopen(const MapCommand& command, PreparedRun& run) {
  if (std::unique_ptr<SampleSource> again = run.source->again(range_age_of(run.config))) {
    run.source = with_signs(std::move(again), run.signs);
    return {};
  }
  Result<std::unique_ptr<SampleSource>> opened = open_input(command, run);
  if (!opened) return opened.error();
  run.source = std::move(opened).value();
  return {};
}

/// Signs that look likely in no stretch as it is read first are left to be mended where they are sure: at the
/// age found, a stretch may look likely that no map was held against.
Result<PreparedRun> read_first(const MapCommand& command, const Configuration& config, LostSigns signs,
                               const std::stop_token& stop) {
  Result<std::unique_ptr<SampleSource>> opened = open_input(command, config, signs);
  if (!opened) return opened.error();
  PreparedRun run{config, std::move(opened).value(), {}, signs, {}};
  if (!command.calibrate || command.odometry_only) return run;
  run.calibration = calibrate_first(*run.source, run.config, stop);
  if (stop.stop_requested()) return stopped_error(command.input);
  if (signs == LostSigns::kMendedIfLikely && prior_cost(run.source->mended()) == 0.0)
    run.signs = LostSigns::kMendedIfSure;
  if (Status again = reopen(command, run); !again) return again.error();
  return run;
}

/// Of the final map; nothing where none was made. The input is at its end then. What damages it is reported
/// when it is mapped for good.
Result<std::optional<double>> misfit_of(const MapCommand& command, const PreparedRun& run,
                                        const std::stop_token& stop) {
  Configuration once = run.config;
  once.backend.map_again = false;
  once.backend.floor_varies = false;
  Pipeline pipeline(once, *run.source);
  for (Result<bool> more = true; more && *more; more = pipeline.step())
    if (stop.stop_requested()) return stopped_error(command.input);
  return std::as_const(pipeline).backend().counters().misfit;
}

/// Mended signs are accepted where the map made with them explains the ranges better, by more than they cost
/// beforehand. Without both maps there is no evidence.
Result<PreparedRun> choose_signs(const MapCommand& command, PreparedRun mended, PreparedRun reported,
                                 const std::stop_token& stop) {
  const Result<std::optional<double>> with_mended = misfit_of(command, mended, stop);
  if (!with_mended) return with_mended.error();
  const Result<std::optional<double>> as_reported = misfit_of(command, reported, stop);
  if (!as_reported) return as_reported.error();
  const double signs_cost = prior_cost(mended.source->mended());
  const bool is_better =
      signs_cost > 0.0 && *with_mended && *as_reported && **as_reported - **with_mended > signs_cost;
  PreparedRun chosen = std::move(is_better ? mended : reported);
  if (!is_better)
    chosen.notes.emplace_back(
        "the odometry may report reverse driving as forward, but a map of that explains the ranges "
        "no better; it is taken as reported");
  if (Status again = reopen(command, chosen); !again) return again.error();
  return chosen;
}

}  // namespace

Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command, const PreparedRun& run) {
  return open_input(command, run.config, run.signs);
}

Result<PreparedRun> prepare_run(const MapCommand& command, const std::stop_token& stop) {
  if (Status finite = check_has_an_end(command.input); !finite) return finite.error();
  const Result<Configuration> config = configuration_for(command);
  if (!config) return config.error();
  const bool is_judged = command.calibrate && config->backend.close_loops && config->backend.refine;
  const LostSigns signs = command.odometry_only ? LostSigns::kAsReported
                          : is_judged           ? LostSigns::kMendedIfLikely
                                                : LostSigns::kMendedIfSure;
  Result<PreparedRun> read = read_first(command, *config, signs, stop);
  if (!read || read->signs != LostSigns::kMendedIfLikely) return read;
  Result<PreparedRun> as_reported = read_first(command, *config, LostSigns::kAsReported, stop);
  if (!as_reported) return as_reported;
  return choose_signs(command, std::move(read).value(), std::move(as_reported).value(), stop);
}

Status check_usable(const MapCommand& command, const InputReport& report, const Backend& backend) {
  if (backend.scans().size() > 0) return {};
  const std::string reason =
      report.problems.empty() ? "it ended before the first one" : report.problems.front();
  return Error{ErrorCode::kInvalidInput, command.input + " holds no usable sample: " + reason};
}

InputReport report_of(const PreparedRun& run, const Status& ended) {
  InputReport report = run.source->report();
  std::vector<std::string>& problems = report.problems;
  if (!ended && std::find(problems.begin(), problems.end(), ended.error().message) == problems.end())
    problems.push_back(ended.error().message);
  report.notes.insert(report.notes.end(), run.notes.begin(), run.notes.end());
  if (!run.calibration) return report;
  const SensorModel used = run.config.sensor.applied_to(run.source->sensor());
  if (const auto note = calibration_note(*run.calibration, used)) report.notes.push_back(*note);
  return report;
}

Error stopped_error(const std::string& input) {
  return {ErrorCode::kTimeout, input + ": mapping was stopped before its end"};
}

}  // namespace swiftlet
