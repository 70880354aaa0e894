// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/calibration_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "daemon/config/configuration.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The ranges are 20 ms older than was set, the rest is as it was; sideways nothing can be estimated.
CalibrationReport report_of(const std::string& uri) {
  JointEstimate estimate;
  estimate.errors(index_of(SystematicError::kRangeAge)) = 0.02;
  estimate.errors(index_of(SystematicError::kYawPerSecond)) = radians(0.5);
  estimate.sigma << 0.003, 0.003, 0.5, radians(0.05), 0.003, radians(0.01);
  estimate.returns_on_them = 5000;
  CalibrationReport report{uri, 4000, {400.0, 200.0, 50.0, 90.0}, {}, CalibrationCheck{0.060, 0.050}};
  report.findings = judge_estimate(estimate, report.motion, SensorModel::crazyflie());
  return report;
}

Result<Configuration> loaded(const std::string& toml) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_calibration.toml");
  std::ofstream(path) << toml;
  Result<Configuration> config = load_configuration(path.string());
  std::filesystem::remove(path);
  return config;
}

TEST(CalibrationToml, IsAConfigurationThatSetsWhatMatters) {
  const Result<Configuration> config = loaded(calibration_toml(report_of("flight.pcap")));
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_NEAR(config->sensor.range_age_s.value_or(0.0), 0.12, 1e-6);
  EXPECT_NEAR(config->sensor.missed_yaw_per_second_rad.value_or(0.0), radians(0.5), 1e-6);
  EXPECT_FALSE(config->sensor.odometry_forward_scale);
  EXPECT_FALSE(config->sensor.odometry_sideways_scale);
}

TEST(CalibrationToml, EverySettingThatCanBeFoundIsOneOfTheConfiguration) {
  CalibrationReport report = report_of("flight.pcap");
  for (CalibrationFinding& finding : report.findings) {
    finding.verdict = CalibrationFinding::Verdict::kMatters;
    finding.value = finding.present;
  }
  const Result<Configuration> config = loaded(calibration_toml(report));
  EXPECT_TRUE(config) << config.error().message;
}

TEST(CalibrationToml, SetsNothingThatMakesTheMapWorse) {
  CalibrationReport report = report_of("flight.pcap");
  report.check = CalibrationCheck{0.050, 0.060};
  const Result<Configuration> config = loaded(calibration_toml(report));
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_FALSE(config->sensor.range_age_s);
  EXPECT_THAT(calibration_text(report), HasSubstr("worse than before"));
}

TEST(CalibrationToml, ANameOverTwoLinesStaysAComment) {
  EXPECT_TRUE(loaded(calibration_toml(report_of("a\nrange_age_s = 7\n.pcap"))));
}

TEST(CalibrationText, TellsInDegreesWhatMattersAndWhatCannotBeTold) {
  const std::string text = calibration_text(report_of("flight.pcap"));
  EXPECT_THAT(text, AllOf(HasSubstr("flight.pcap: 4000 samples in 400 s"), HasSubstr("0.1200 +- 0.0030"),
                          HasSubstr("yaw missed per second, deg/s"), HasSubstr("0.5000 +- 0.0100"),
                          HasSubstr("MATTERS"), HasSubstr("not observable: known to +- 0.5 only"),
                          HasSubstr("60.0 mm off the walls, with what matters set 50.0 mm")));
  EXPECT_THAT(text, Not(HasSubstr("worse")));
}

TEST(CalibrationJson, HoldsFiguresOnlyWhereThereAreAny) {
  const nlohmann::json json = nlohmann::json::parse(calibration_json(report_of("flight.pcap")));
  EXPECT_EQ(json["samples"], 4000);
  ASSERT_EQ(json["findings"].size(), kSystematicErrors);
  EXPECT_EQ(json["findings"][0]["setting"], "sensor.range_age_s");
  EXPECT_EQ(json["findings"][0]["verdict"], "matters");
  EXPECT_NEAR(json["findings"][0]["value"].get<double>(), 0.12, 1e-9);
  EXPECT_EQ(json["findings"][2]["verdict"], "not_observable");
  EXPECT_FALSE(json["findings"][2].contains("value"));
  EXPECT_FALSE(json["check"]["is_worse"].get<bool>());
}

}  // namespace
}  // namespace swiftlet
