// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/calibration_rounds.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "core/calibration/calibration_findings.hpp"
#include "core/run/mapping_run.hpp"

namespace swiftlet {
namespace {

// An estimate moves each scan along its twist, which is only right for short moves: then the ranges are
// paired with dead reckoning anew.
constexpr int kMaxRounds = 3;
constexpr Duration kSettledAge = std::chrono::milliseconds(5);

/// The work is done in this many parts: two for each round, one for the check.
constexpr int kParts = 2 * kMaxRounds + 1;

/// One pairing of ranges with dead reckoning, and what came of it.
struct Round {
  SensorModel sensor;
  bool shows_age = true;
  std::size_t samples = 0;
  MotionSummary motion;
  BackendCounters counters;
  std::optional<JointEstimate> estimate;  // nothing where the run has too little motion
};

class Calibration {
 public:
  Calibration(const std::string& name, const ReadRun& read_run, const GoOn& go_on)
      : name_(name), read_run_(read_run), go_on_(go_on) {}

  Result<CalibrationReport> run();

 private:
  [[nodiscard]] Result<Round> run_round(std::optional<Duration> range_age);
  [[nodiscard]] Result<CalibrationCheck> check(const CalibrationFindings& findings, const SensorModel& first,
                                               const BackendCounters& before);
  [[nodiscard]] GoOn next_part();

  const std::string& name_;
  const ReadRun& read_run_;
  const GoOn& go_on_;
  int parts_begun_ = 0;
};

GoOn Calibration::next_part() {
  const int part = parts_begun_++;
  return [this, part](double done) { return go_on_((part + done) / kParts); };
}

Result<Round> Calibration::run_round(std::optional<Duration> range_age) {
  const Result<PairedRun> read = read_run_(range_age);
  if (!read) return read.error();
  const PairedRun& run = *read;
  Round round{run.sensor, run.shows_age, run.samples.size(), {}, {}, std::nullopt};
  const std::vector<CalibrationScan> scans = calibration_scans(run.samples, run.beams);
  round.motion = summarize_motion(scans);
  if (why_hopeless(round.motion)) return round;
  Result<MappingRun> map = map_samples(run.samples, {.sensor = run.sensor}, run.beams, next_part());
  if (!map) return map.error();
  round.counters = map->counters;
  const Result<JointEstimate> estimate = estimate_jointly(scans, run.sensor, map->T_map_body, next_part());
  if (!estimate) return estimate.error();
  round.estimate = *estimate;
  return round;
}

/// The whole run again, with what matters set.
Result<CalibrationCheck> Calibration::check(const CalibrationFindings& findings, const SensorModel& first,
                                            const BackendCounters& before) {
  const SensorModel sensor = calibrated(findings, first);
  const Result<PairedRun> run = read_run_(sensor.range_age);
  if (!run) return run.error();
  const Result<MappingRun> map = map_samples(run->samples, {.sensor = sensor}, run->beams, next_part());
  if (!map) return map.error();
  return CalibrationCheck{before.held_out_after_m, map->counters.held_out_after_m};
}

/// An age remains among the unknowns, for what is off beside it, but no setting follows from it.
CalibrationFindings with_no_age(CalibrationFindings findings) {
  CalibrationFinding& age = findings[static_cast<std::size_t>(SystematicError::kRangeAge)];
  age.verdict = CalibrationFinding::Verdict::kNotObservable;
  age.reason = "ranges and dead reckoning of this input have one stamp, which shows no age";
  return findings;
}

/// Moves what was found at the last pairing's age to where the first one's stands.
CalibrationFindings findings_of(const Round& first, const Round& last) {
  const SensorModel& sensor = first.sensor;
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
    return Error{ErrorCode::kInvalidInput, name_ + " holds no usable run: too few samples"};
  Round last = first;
  for (int round = 1; round < kMaxRounds && last.estimate && last.shows_age; ++round) {
    const double shift_s = last.estimate->errors(index_of(SystematicError::kRangeAge));
    const Duration age = within_limits_of_range_age(last.sensor.range_age + from_seconds(shift_s));
    if (std::chrono::abs(age - last.sensor.range_age) < kSettledAge) break;
    const Result<Round> again = run_round(age);
    if (!again) return again.error();
    last = *again;
  }
  CalibrationReport report{name_, first.samples, first.motion, findings_of(first, last), std::nullopt};
  if (!first.shows_age) report.findings = with_no_age(report.findings);
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

}  // namespace

Result<CalibrationReport> calibrate_in_rounds(const std::string& name, const ReadRun& read_run,
                                              const GoOn& go_on) {
  return Calibration(name, read_run, go_on).run();
}

}  // namespace swiftlet
