// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibrate_command.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <system_error>

#include "daemon/outputs/file_writer.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "tools/calibration/calibration_report.hpp"
#include "tools/calibration/calibration_rounds.hpp"
#include "tools/command_end.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

/// The whole input in memory. `report`: the input's report when it was first read.
Result<PairedRun> read_input(const CalibrateCommand& command, std::optional<Duration> range_age,
                             const std::stop_token& stop, InputReport& report) {
  SampleSourceOptions options;
  options.beam_count = command.beams;
  options.range_age = range_age;
  const Result<std::unique_ptr<SampleSource>> opened = open_sample_source(command.input, options);
  if (!opened) return opened.error();
  SampleSource& source = **opened;
  PairedRun run{{}, source.beams(), source.sensor(), source.report().shows_age};
  while (!stop.stop_requested()) {
    const Result<ReceivedSample> received = source.next();
    if (received) run.samples.push_back(received->sample);
    if (!received && received.error().code == ErrorCode::kEndOfRecording) break;
    if (!received && received.error().code != ErrorCode::kTimeout) return received.error();
  }
  if (!range_age) report = source.report();
  return run;
}

/// `input`: what the input reports about itself.
Result<CalibrationReport> calibrate(const CalibrateCommand& command, const std::stop_token& stop,
                                    InputReport& input) {
  ProgressBar bar(stderr, ProgressBar::Clock::now());
  const ReadRun read_run = [&](std::optional<Duration> range_age) {
    return read_input(command, range_age, stop, input);
  };
  const GoOn go_on = [&](double done) {
    bar.update(done, ProgressBar::Clock::now());
    return !stop.stop_requested();
  };
  Result<CalibrationReport> report = calibrate_in_rounds(command.input, read_run, go_on);
  if (stop.stop_requested())
    return Error{ErrorCode::kTimeout, "calibration stopped before its end; nothing was written"};
  return report;
}

/// Asked before the work.
Status check_toml_file(const fs::path& file, const std::string& input) {
  if (Status usable = check_output_file(file, std::array{fs::path(file_of_input(input))}); !usable)
    return usable;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  return Error{ErrorCode::kInvalidInput,
               file.string() + ": is there already; name another file or remove it"};
}

Status check_request(const CalibrateCommand& command) {
  const Result<InputUri> input = parse_input_uri(command.input);
  if (!input) return input.error();
  if (input->is(InputNature::kVehicle))
    return Error{ErrorCode::kInvalidInput, command.input +
                                               ": a whole flight is needed at once; record it first with "
                                               "swiftlet record, then calibrate from the recording"};
  return command.toml_file.empty() ? Status() : check_toml_file(command.toml_file, command.input);
}

/// The results come first: they are there whatever becomes of the file.
Status write_results(const CalibrateCommand& command, const CalibrationReport& report) {
  std::fputs((command.json ? calibration_json(report) : calibration_text(report)).c_str(), stdout);
  if (command.toml_file.empty()) return {};
  if (Status written = write_file(command.toml_file, calibration_toml(report)); !written) return written;
  if (!command.json)
    std::printf("file: %s: for --config of swiftlet map and swiftletd\n", command.toml_file.c_str());
  return {};
}

}  // namespace

Status run_calibrate_command(const CalibrateCommand& command) {
  const SignalWatcher signals;
  if (Status usable = check_request(command); !usable) return usable;
  InputReport input;
  const Result<CalibrationReport> report = calibrate(command, signals.token(), input);
  if (!report) return report.error();
  return conclude(write_results(command, *report), input);
}

}  // namespace swiftlet
