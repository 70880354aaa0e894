// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/flight_table_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<RangeSample> samples_of(SampleSource& source) {
  std::vector<RangeSample> samples;
  for (Result<ReceivedSample> next = source.next();; next = source.next()) {
    if (!next && next.error().code == ErrorCode::kEndOfRecording) return samples;
    if (next) samples.push_back(next->sample);
  }
}

const std::string kFlightHead =
    "# block,host_time_s,device_ms,... block 1: x_m,y_m | block 2: qw,qx,qy,qz,front_m\n";
/// At 0.1 s apart: position (0.1, 0.2) and (0.3, 0.2), height 0.5, yaw 0, ranges in between.
const std::string kFlight =
    "1,1600000000.000000,15000,0.1,0.2,0.5,0,0,0,0,0,0,4.1,40\n"
    "2,1600000000.000001,15000,1,0,0,0,1.5,2.5,0.5,3.5,2\n"
    "1,1600000000.100000,15100,0.3,0.2,0.5,0,0,0,0,0,0,4.1,40\n"
    "2,1600000000.100001,15100,1,0,0,0,1.25,32.766,0,0.75,2\n"
    "1,1600000000.200000,15200,0.5,0.2,0.5,0,0,0,0,0,0,4.1,40\n"
    "2,1600000000.200001,15200,1,0,0,0,1.25,32.766,0,0.75,2\n";

TEST(FlightTableSource, ReadsTheBlocksOfAFlight) {
  const TemporaryFile file("a.csv", kFlightHead + kFlight);
  const auto source = open_sample_source(file.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = samples_of(**source);
  ASSERT_EQ(samples.size(), 2U);
  // The ranges are 0.1 s older than their packet.
  EXPECT_NEAR(samples[1].T_odom_body.x_m(), 0.3, 1e-9);
  EXPECT_NEAR(samples[1].T_odom_body.yaw_rad(), 0.0, 1e-9);
  EXPECT_TRUE((*source)->report().problems.empty());
  EXPECT_EQ((*source)->report().counters.frames, 7U);
}

TEST(FlightTableSource, RangesGoToTheBeamsThatMeasuredThem) {
  const TemporaryFile file("a.csv", kFlightHead + kFlight);
  SampleSourceOptions options;
  options.range_age = Duration::zero();
  const auto source = open_sample_source(file.path(), options);
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = samples_of(**source);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_FLOAT_EQ(samples[0].distance_m[0], 1.5F);          // front
  EXPECT_FLOAT_EQ(samples[0].distance_m[1], 0.5F);          // left
  EXPECT_FLOAT_EQ(samples[0].distance_m[2], 2.5F);          // back
  EXPECT_EQ(samples[0].status[3], RangeStatus::kNoReturn);  // right, beyond the sensor
  EXPECT_EQ(samples[1].status[1], RangeStatus::kInvalid);
  EXPECT_EQ(samples[1].status[2], RangeStatus::kNoReturn);
}

TEST(FlightTableSource, LearnsHowOftenPositionsCome) {
  std::string rows;
  for (int ms = 15'000; ms <= 20'000; ms += 100) {
    const std::string stamps = "," + std::to_string(1'600'000'000 + ms / 1000) + "," + std::to_string(ms);
    if (ms % 500 == 0) rows += "1" + stamps + ",0.1,0.2,0.5\n";
    rows += "2" + stamps + ",1,0,0,0,1.5,2.5,0.5,3.5\n";
  }
  const TemporaryFile file("a.csv", kFlightHead + rows);
  const auto source = open_sample_source(file.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ(samples_of(**source).size(), 50U);
  EXPECT_EQ((*source)->report().counters.gaps, 0U);
}

TEST(FlightTableSource, SkipsEmptyLines) {
  const TemporaryFile file("a.csv", kFlightHead + "\n" + kFlight + "\n\r\n");
  const auto source = open_sample_source(file.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ(samples_of(**source).size(), 2U);
  EXPECT_TRUE((*source)->report().problems.empty());
  EXPECT_EQ((*source)->report().counters.frames, 7U);
}

TEST(FlightTableSource, IsUsedUpToARowThatCannotBe) {
  for (const std::string& row :
       {std::string("3,1600000000.3,15300,1\n"), std::string("2,1600000000.3,15300,1,0,0\n"),
        std::string("1,1600000000.3,x,0,0\n"), std::string(" \n")}) {
    std::string text = kFlightHead;
    text.append(kFlight).append(row).append(kFlight);
    const TemporaryFile file("a.csv", text);
    const auto source = open_sample_source(file.path(), {});
    ASSERT_TRUE(source.ok());
    EXPECT_EQ(samples_of(**source).size(), 2U) << row;
    EXPECT_THAT((*source)->report().problems, ElementsAre(HasSubstr("line 8: is no row of a log block")))
        << row;
    EXPECT_TRUE(samples_of(**source).empty());
  }
}

TEST(FlightTableSource, GivesTheSamplesOfTheCapture) {
  const std::string table = reference_file("flights/olsson.csv");
  SWIFTLET_REQUIRE_REFERENCE(table);
  const auto from_table = open_sample_source(table, {});
  const auto from_capture = open_sample_source(reference_file("flights/olsson.pcap"), {});
  ASSERT_TRUE(from_table.ok() && from_capture.ok());
  const std::vector<RangeSample> samples = samples_of(**from_table);
  const std::vector<RangeSample> expected = samples_of(**from_capture);
  ASSERT_EQ(samples.size(), expected.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(samples[i].stamp, expected[i].stamp) << i;
    ASSERT_EQ(samples[i].measured_at, expected[i].measured_at) << i;
    ASSERT_EQ(samples[i].status, expected[i].status) << i;
    for (std::size_t beam = 0; beam < samples[i].beam_count;
         ++beam)  // the attitude is rounded to nine digits
      ASSERT_NEAR(samples[i].distance_m[beam], expected[i].distance_m[beam], 1e-5) << i;
    ASSERT_EQ(samples[i].starts_segment, expected[i].starts_segment) << i;
    ASSERT_NEAR(samples[i].T_odom_body.x_m(), expected[i].T_odom_body.x_m(), 1e-9) << i;
    ASSERT_NEAR(samples[i].T_odom_body.y_m(), expected[i].T_odom_body.y_m(), 1e-9) << i;
    ASSERT_NEAR(samples[i].T_odom_body.yaw_rad(), expected[i].T_odom_body.yaw_rad(), 1e-7) << i;
  }
}

}  // namespace
}  // namespace swiftlet
