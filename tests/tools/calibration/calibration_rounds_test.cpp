// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/calibration_rounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>

#include "firmware_link/input/open_sample_source.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

bool go_on(double) { return true; }

/// A vehicle that stands between two walls.
PairedRun standing(int samples) {
  PairedRun run{{}, BeamLayout::multiranger(), SensorModel::crazyflie()};
  for (int i = 0; i < samples; ++i) {
    RangeSample sample;
    sample.stamp = HostTime(std::chrono::milliseconds(100 * i));
    sample.measured_at = DeviceTime(std::chrono::milliseconds(100 * i));
    sample.starts_segment = i == 0;
    sample.beam_count = 4;
    sample.status.fill(RangeStatus::kHit);
    sample.distance_m.fill(1.0F);
    run.samples.push_back(sample);
  }
  return run;
}

/// Its ranges are 0.17 s old, not 0.1 s as in the sensor model.
Result<PairedRun> simulated_flight(std::optional<Duration> range_age) {
  SampleSourceOptions options;
  options.range_age = range_age;
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source("sim://office?seed=4", options);
  if (!source) return source.error();
  PairedRun run{{}, (*source)->beams(), (*source)->sensor()};
  for (;;) {
    const Result<ReceivedSample> received = (*source)->next();
    if (received) run.samples.push_back(received->sample);
    if (!received && received.error().code != ErrorCode::kTimeout) return run;
  }
}

TEST(CalibrationRounds, ReadTheRunAnewAtTheAgeThatWasFoundAndOnceMoreWithWhatMatters) {
  std::vector<std::optional<Duration>> asked;
  const ReadRun read = [&](std::optional<Duration> range_age) {
    asked.push_back(range_age);
    return simulated_flight(range_age);
  };
  double done = 0.0;
  const Result<CalibrationReport> report = calibrate_in_rounds("a flight", read, [&](double now_done) {
    EXPECT_GE(now_done, done);
    EXPECT_LE(now_done, 1.0);
    done = now_done;
    return true;
  });
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_GE(asked.size(), 3U);
  EXPECT_FALSE(asked.front());
  EXPECT_NEAR(to_seconds(asked.at(1).value_or(Duration::zero())), 0.17, 0.03);
  EXPECT_EQ(report->input_uri, "a flight");
  EXPECT_NEAR(report->findings[0].present, 0.1, 1e-9) << "not the age of a later round";
  EXPECT_EQ(asked.back(), from_seconds(report->findings[0].value));
  ASSERT_TRUE(report->check);
  EXPECT_FALSE(report->check->is_worse());
}

TEST(CalibrationRounds, AVehicleThatStoodIsReadOnceAndTellsNothing) {
  int times_read = 0;
  const ReadRun read = [&](std::optional<Duration>) -> Result<PairedRun> {
    ++times_read;
    return standing(100);
  };
  const Result<CalibrationReport> report = calibrate_in_rounds("a stand", read, go_on);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(times_read, 1);
  EXPECT_EQ(report->samples, 100U);
  EXPECT_FALSE(report->check);
  for (const CalibrationFinding& finding : report->findings)
    EXPECT_EQ(finding.verdict, CalibrationFinding::Verdict::kNotObservable);
}

TEST(CalibrationRounds, ARunThatShowsNoAgeIsEstimatedOnceAndItsAgeIsNotObservable) {
  std::vector<std::optional<Duration>> asked;
  const ReadRun read = [&](std::optional<Duration> range_age) -> Result<PairedRun> {
    asked.push_back(range_age);
    Result<PairedRun> run = simulated_flight(std::nullopt);  // its age is 0.07 s off, and stays so
    if (run) run->shows_age = false;
    return run;
  };
  const Result<CalibrationReport> report = calibrate_in_rounds("a table", read, go_on);
  ASSERT_TRUE(report) << report.error().message;
  const CalibrationFinding& age = report->findings[0];
  EXPECT_EQ(age.verdict, CalibrationFinding::Verdict::kNotObservable);
  EXPECT_THAT(age.reason, HasSubstr("have one stamp, which shows no age"));
  EXPECT_NE(report->findings[1].verdict, CalibrationFinding::Verdict::kNotObservable) << "the forward scale";
  EXPECT_FALSE(asked.at(0));
  ASSERT_EQ(asked.size(), report->check ? 2U : 1U) << "once, and where something matters once with it";
  EXPECT_TRUE(!report->check || asked.at(1) == SensorModel::crazyflie().range_age);
}

TEST(CalibrationRounds, OneSampleIsNoRun) {
  const Result<CalibrationReport> report = calibrate_in_rounds(
      "a blink", [](std::optional<Duration>) { return Result<PairedRun>(standing(1)); }, go_on);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(report.error().message, HasSubstr("a blink holds no usable run"));
}

TEST(CalibrationRounds, WhatCannotBeReadSaysWhy) {
  const ReadRun read = [](std::optional<Duration>) -> Result<PairedRun> {
    return Error{ErrorCode::kNotFound, "nowhere.pcap: no such file"};
  };
  const Result<CalibrationReport> report = calibrate_in_rounds("nowhere.pcap", read, go_on);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(report.error().message, "nowhere.pcap: no such file");
}

TEST(CalibrationRounds, EndWhenToldTo) {
  const Result<CalibrationReport> report =
      calibrate_in_rounds("a flight", simulated_flight, [](double) { return false; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kTimeout);
}

}  // namespace
}  // namespace swiftlet
