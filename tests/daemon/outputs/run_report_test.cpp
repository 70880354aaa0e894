// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_report.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "tests/daemon/outputs/finished_run.hpp"

namespace swiftlet {
namespace {

using nlohmann::json;

TEST(RunReport, TellsWhatCameInAndWhatWasMadeOfIt) {
  const FinishedRun run;
  const json report = json::parse(run_report_json(run.view(false)));
  EXPECT_EQ(report["input"]["uri"], "sim://room");
  EXPECT_EQ(report["input"]["samples"], 81);
  EXPECT_EQ(report["input"]["notes"], json({"a note"}));
  EXPECT_EQ(report["input"]["problems"], json({"damaged at byte 123"}));
  EXPECT_EQ(report["sensor"]["beams"], 4);
  EXPECT_EQ(report["frontend"]["keyframes"], 17);
  EXPECT_EQ(report["backend"]["scans"], 81);
  EXPECT_EQ(report["backend"]["keyframes"], 17);
  EXPECT_EQ(report["backend"]["closures"]["accepted"], 0);
  EXPECT_EQ(report["backend"]["windows"]["refined"], 0);
  EXPECT_EQ(report["backend"]["windows"]["refused"], 0);
  EXPECT_EQ(report["backend"]["stretches"]["refined"], 0);
  EXPECT_EQ(report["backend"]["stretches"]["refused"], 0);
  EXPECT_EQ(report["backend"]["map_source"], "pose graph");
  EXPECT_EQ(report["backend"]["yaw_noise_factor"], 1.0);
  EXPECT_EQ(report["backend"]["floor_cost"], 0.0);
  EXPECT_EQ(report["tracking"]["state"], "tracking");
  EXPECT_EQ(report["tracking"]["places_weighed"], 0);
  EXPECT_EQ(report["tracking"]["place_lead"], 0.0);
  EXPECT_GE(report["tracking"]["innovation"], 0.0);
  EXPECT_NEAR(report["tracking"]["way_since_agreement_m"].get<double>(), 8.0, 1e-9)
      << "there is no older map";
  EXPECT_NEAR(report["trajectory"]["duration_s"].get<double>(), 8.0, 1e-9);
  EXPECT_NEAR(report["trajectory"]["odometry_length_m"].get<double>(), 8.0, 1e-9);
  EXPECT_GT(report["map"]["tiles"], 0);
  EXPECT_EQ(report["stage_times"]["frontend"]["p99_ms"], 0.4);
  EXPECT_EQ(report["stage_times"]["frontend"]["p999_ms"], 0.45);
  EXPECT_EQ(report["histograms_ns"]["frontend"], json({{90'111, 80}, {507'903, 1}}));
  EXPECT_FALSE(report.contains("queues")) << "nobody published";
  EXPECT_EQ(report["run_peak_memory_mb"], 12.5);
  EXPECT_GT(report["peak_memory_mb"].get<double>(), 1.0);
  EXPECT_FALSE(report.contains("absolute_trajectory_error"));
}

TEST(RunReport, TellsOfQueuesAndDeadlinesWhereSomebodyPublished) {
  FinishedRun run;
  run.timing.queues = {{.name = "poses", .capacity = 256, .high_water = 3, .refused = 1}};
  run.timing.missed_deadlines = 5;
  const json report = json::parse(run_report_json(run.view(false)));
  EXPECT_EQ(report["queues"]["poses"]["high_water"], 3);
  EXPECT_EQ(report["queues"]["poses"]["refused"], 1);
  EXPECT_EQ(report["pose_deadline"], json({{"ms", 2.0}, {"missed", 5}}));
}

TEST(RunReport, GivesTheErrorWhereTheTruthIsKnown) {
  const FinishedRun run;
  const json report = json::parse(run_report_json(run.view(true)));
  // Positions 0, 0.1, .. 8 m against ones a tenth farther apart: a tenth of the spread of the former.
  const double spread = 0.1 * std::sqrt((81.0 * 81.0 - 1.0) / 12.0);
  EXPECT_NEAR(report["absolute_trajectory_error"]["odometry"]["rmse_m"].get<double>(), 0.1 * spread, 1e-9);
  EXPECT_EQ(report["absolute_trajectory_error"]["samples"], 81);
}

TEST(RunReport, GivesTheKnownPlaceErrorWherePosesWereKept) {
  const FinishedRun run;
  RunView view = run.view(true);
  EXPECT_FALSE(json::parse(run_report_json(view)).contains("known_place_error"));
  view.known_places = KnownPlaceError{.moments = 3, .rms_m = 0.25};
  const json report = json::parse(run_report_json(view));
  EXPECT_EQ(report["known_place_error"]["moments"], 3);
  EXPECT_EQ(report["known_place_error"]["rms_m"], 0.25);
  EXPECT_EQ(report["known_place_error"]["across_p95_m"], nullptr);
}

TEST(RunReport, AnErrorOfNoMomentsIsUnknownNotZero) {
  const FinishedRun run;
  RunView view = run.view(true);
  view.known_places = KnownPlaceError{};
  const json error = json::parse(run_report_json(view))["known_place_error"];
  for (const char* figure : {"rms_m", "p95_m", "max_m", "share_off", "settled_p50_s"})
    EXPECT_TRUE(error[figure].is_null()) << figure;
}

TEST(RunReport, TellsWhatTheInputShowedOfItsSensors) {
  const FinishedRun run;
  RunView view = run.view(false);
  EXPECT_TRUE(json::parse(run_report_json(view))["calibration"].is_null());
  view.calibration = InputCalibration{SensorModel::crazyflie(), SensorModel::crazyflie()};
  view.calibration->found.range_age = std::chrono::milliseconds(50);
  view.calibration->sigma(index_of(SystematicError::kRangeAge)) = 0.01;
  const json calibration = json::parse(run_report_json(view))["calibration"];
  EXPECT_EQ(calibration.size(), 1U);
  EXPECT_EQ(calibration["range_age_s"]["expected"], 0.1);
  EXPECT_EQ(calibration["range_age_s"]["found"], 0.05);
  EXPECT_EQ(calibration["range_age_s"]["sigma"], 0.01);
}

TEST(RunReport, SurvivesNamesThatAreNotText) {
  const FinishedRun run;
  RunView view = run.view(false);
  view.input_uri = "replay:caf\xe9.pcap";
  EXPECT_TRUE(json::parse(run_report_json(view)).is_object());
}

TEST(RunReport, OfARunOfNothingIsStillOne) {
  const FinishedRun run(0);
  const json report = json::parse(run_report_json(run.view(true)));
  EXPECT_EQ(report["backend"]["scans"], 0);
  EXPECT_EQ(report["map"]["tiles"], 0);
}

}  // namespace
}  // namespace swiftlet
