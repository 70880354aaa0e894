// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/prepared_run.hpp"

#include <utility>

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

}  // namespace

Result<std::unique_ptr<SampleSource>> open_input(const MapCommand& command, const Configuration& config) {
  SampleSourceOptions options;
  options.beam_count = command.beams;
  options.max_range_m = config.sensor.max_range_m;
  options.min_range_m = config.sensor.min_range_m;
  options.range_age = range_age_of(config);
  Result<std::unique_ptr<SampleSource>> source = open_sample_source(command.input, options);
  if (!source || command.odometry_only) return source;
  return std::unique_ptr<SampleSource>(std::make_unique<SignMendingSource>(std::move(source).value()));
}

Result<PreparedRun> prepare_run(const MapCommand& command, const std::stop_token& stop) {
  if (Status finite = check_has_an_end(command.input); !finite) return finite.error();
  Result<Configuration> config = configuration_for(command);
  if (!config) return config.error();
  Result<std::unique_ptr<SampleSource>> opened = open_input(command, *config);
  if (!opened) return opened.error();
  PreparedRun run{std::move(config).value(), std::move(opened).value(), {}};
  if (!command.calibrate || command.odometry_only) return run;
  run.calibration = calibrate_first(*run.source, run.config, stop);
  if (stop.stop_requested()) return stopped_error(command.input);
  if (std::unique_ptr<SampleSource> again = run.source->again(range_age_of(run.config))) {
    run.source = std::move(again);
    return run;
  }
  opened = open_input(command, run.config);
  if (!opened) return opened.error();
  run.source = std::move(opened).value();
  return run;
}

Status check_usable(const MapCommand& command, const InputReport& report, const Backend& backend) {
  if (backend.scans().size() > 0) return {};
  const std::string reason =
      report.problems.empty() ? "it ended before the first one" : report.problems.front();
  return Error{ErrorCode::kInvalidInput, command.input + " holds no usable sample: " + reason};
}

Status damage_of(const InputReport& report) {
  if (report.problems.empty()) return {};
  std::string message = report.problems.front();
  for (std::size_t i = 1; i < report.problems.size(); ++i) message += "; " + report.problems[i];
  return Error{ErrorCode::kDamaged, message};
}

Error stopped_error(const std::string& input) {
  return {ErrorCode::kTimeout, input + ": mapping was stopped before its end"};
}

}  // namespace swiftlet
