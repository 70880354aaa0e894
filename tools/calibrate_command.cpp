// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibrate_command.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/calibration/calibration_findings.hpp"
#include "core/calibration/joint_problem.hpp"
#include "core/calibration/mapping_run.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/signal_watcher.hpp"
#include "firmware_link/input_uri.hpp"
#include "firmware_link/sample_source.hpp"
#include "tools/calibration/calibration_report.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {
namespace {

// An estimate moves each scan along its twist, which is only right for short moves: then the ranges are
// paired with dead reckoning anew.
constexpr int kMostRounds = 3;
constexpr Duration kSettledAge = std::chrono::milliseconds(5);
constexpr Duration kLongestAge = std::chrono::seconds(1);

/// The work is done in this many parts: two for each round, one for the check.
constexpr int kParts = 2 * kMostRounds + 1;

struct Samples {
  std::vector<RangeSample> all;
  BeamLayout beams;
  SensorModel sensor;
  InputReport report;
};

/// One pairing of ranges with dead reckoning, and what came of it.
struct Round {
  SensorModel sensor;
  std::size_t samples = 0;
  MotionSummary motion;
  BackendCounters counters;
  std::optional<JointEstimate> estimate;  // nothing where the run has too little motion
};

class Calibration {
 public:
  Calibration(const CalibrateCommand& command, std::stop_token stop)
      : command_(command), stop_(std::move(stop)), bar_(stderr, ProgressBar::Clock::now()) {}

  Result<CalibrationReport> run();
  [[nodiscard]] const InputReport& input() const { return input_; }

 private:
  [[nodiscard]] Result<Samples> read(std::optional<Duration> range_age) const;
  [[nodiscard]] Result<Round> run_round(std::optional<Duration> range_age);
  [[nodiscard]] Result<CalibrationCheck> check(const CalibrationFindings& findings, const SensorModel& first,
                                               const BackendCounters& before);
  [[nodiscard]] GoOn next_part();

  const CalibrateCommand& command_;
  std::stop_token stop_;
  ProgressBar bar_;
  int parts_begun_ = 0;
  InputReport input_;  // of the first round
};

GoOn Calibration::next_part() {
  const int part = parts_begun_++;
  return [this, part](double done) {
    bar_.update((part + done) / kParts, ProgressBar::Clock::now());
    return !stop_.stop_requested();
  };
}

Result<Samples> Calibration::read(std::optional<Duration> range_age) const {
  SampleSourceOptions options;
  options.beam_count = command_.beams;
  options.range_age = range_age;
  const Result<std::unique_ptr<SampleSource>> opened = open_sample_source(command_.input, options);
  if (!opened) return opened.error();
  SampleSource& source = **opened;
  Samples samples{{}, source.beams(), source.sensor(), {}};
  while (!stop_.stop_requested()) {
    Result<RangeSample> sample = source.next();
    if (sample) samples.all.push_back(*sample);
    if (!sample && sample.error().code == ErrorCode::kEndOfRecording) break;
    if (!sample && sample.error().code != ErrorCode::kTimeout) return sample.error();
  }
  samples.report = source.report();
  return samples;
}

Result<Round> Calibration::run_round(std::optional<Duration> range_age) {
  const Result<Samples> read_samples = read(range_age);
  if (!read_samples) return read_samples.error();
  const Samples& samples = *read_samples;
  if (!range_age) input_ = samples.report;
  Round round{samples.sensor, samples.all.size(), {}, {}, std::nullopt};
  const std::vector<CalibrationScan> scans = calibration_scans(samples.all, samples.beams);
  round.motion = summarize_motion(scans);
  if (why_hopeless(round.motion)) return round;
  Result<MappingRun> map = map_samples(samples.all, samples.sensor, samples.beams, next_part());
  if (!map) return map.error();
  round.counters = map->counters;
  const Result<JointEstimate> estimate =
      estimate_jointly(scans, samples.sensor, map->T_map_body, next_part());
  if (!estimate) return estimate.error();
  round.estimate = *estimate;
  return round;
}

/// The whole run again, with what matters set.
Result<CalibrationCheck> Calibration::check(const CalibrationFindings& findings, const SensorModel& first,
                                            const BackendCounters& before) {
  SensorModel sensor = calibrated(findings, first);
  const Result<Samples> samples = read(sensor.range_age);
  if (!samples) return samples.error();
  const Result<MappingRun> map = map_samples(samples->all, sensor, samples->beams, next_part());
  if (!map) return map.error();
  return CalibrationCheck{before.held_back_after_m, map->counters.held_back_after_m};
}

/// Moves what was found at the last pairing's age to where the first one's stands.
CalibrationFindings findings_of(const Round& first, const Round& last) {
  SensorModel sensor = first.sensor;
  if (!last.estimate) return nothing_observable(*why_hopeless(last.motion), sensor);
  JointEstimate estimate = *last.estimate;
  estimate.errors(index_of(SystematicError::kRangeAge)) +=
      to_seconds(last.sensor.range_age - sensor.range_age);
  return judge_estimate(estimate, last.motion, sensor);
}

Result<CalibrationReport> Calibration::run() {
  const Result<Round> begun = run_round(std::nullopt);
  if (!begun) return begun.error();
  const Round& first = *begun;
  if (first.samples < 2)
    return Error{ErrorCode::kInvalidInput, command_.input + " holds no usable run: too few samples"};
  Round last = first;
  for (int round = 1; round < kMostRounds && last.estimate; ++round) {
    const double shift_s = last.estimate->errors(index_of(SystematicError::kRangeAge));
    const Duration age =
        std::clamp(last.sensor.range_age + from_seconds(shift_s), Duration::zero(), kLongestAge);
    if (std::chrono::abs(age - last.sensor.range_age) < kSettledAge) break;
    const Result<Round> again = run_round(age);
    if (!again) return again.error();
    last = *again;
  }
  CalibrationReport report{command_.input, first.samples, first.motion, findings_of(first, last),
                           std::nullopt};
  const bool changes = std::any_of(report.findings.begin(), report.findings.end(), [](const auto& finding) {
    return finding.verdict == CalibrationFinding::Verdict::kMatters;
  });
  if (!changes) return report;
  parts_begun_ = kParts - 1;
  const Result<CalibrationCheck> checked = check(report.findings, first.sensor, first.counters);
  if (!checked) return checked.error();
  report.check = *checked;
  return report;
}

Status check_request(const CalibrateCommand& command) {
  const Result<InputUri> input = parse_input_uri(command.input);
  if (!input) return input.error();
  if (input->kind != InputUri::Kind::kFile && input->kind != InputUri::Kind::kSimulation)
    return Error{ErrorCode::kInvalidInput, command.input +
                                               ": a whole flight is needed at once; record it first with "
                                               "swiftlet record, then calibrate from the recording"};
  std::error_code ignored;
  if (!command.toml_file.empty() && std::filesystem::exists(command.toml_file, ignored))
    return Error{ErrorCode::kInvalidInput,
                 command.toml_file.string() + ": is there already; name another file or remove it"};
  return {};
}

Status tell(const CalibrateCommand& command, const CalibrationReport& report, const InputReport& input) {
  for (const std::string& note : input.notes) std::fprintf(stderr, "swiftlet: note: %s\n", note.c_str());
  if (!command.toml_file.empty())
    if (Status written = write_file(command.toml_file, calibration_toml(report)); !written) return written;
  std::fputs((command.json ? calibration_json(report) : calibration_text(report)).c_str(), stdout);
  if (!command.toml_file.empty() && !command.json)
    std::printf("file: %s: for --config of swiftlet map and swiftletd\n", command.toml_file.c_str());
  if (input.problems.empty()) return {};
  std::string damage;
  for (const std::string& problem : input.problems) damage += problem + "; ";
  return Error{ErrorCode::kDamaged, damage + "the figures come from what came before"};
}

Result<CalibrationReport> calibrate(Calibration& calibration, const std::stop_token& stop) {
  Result<CalibrationReport> report = calibration.run();
  if (stop.stop_requested())
    return Error{ErrorCode::kTimeout, "calibration stopped before its end; nothing was written"};
  return report;
}

}  // namespace

Status run_calibrate_command(const CalibrateCommand& command) {
  const SignalWatcher signals;
  if (Status usable = check_request(command); !usable) return usable;
  auto calibration = std::make_unique<Calibration>(command, signals.token());
  const Result<CalibrationReport> report = calibrate(*calibration, signals.token());
  const InputReport input = calibration->input();
  calibration.reset();  // and with it the progress bar
  if (!report) return report.error();
  return tell(command, *report, input);
}

}  // namespace swiftlet
