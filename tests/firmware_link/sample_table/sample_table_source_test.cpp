// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/sample_table_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/firmware_link/laser_lines.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Read {
  std::vector<RangeSample> samples;
  BeamLayout beams;
  SensorModel sensor;
  InputReport report;
};

Read read_all(const std::string& uri, const SampleSourceOptions& options = {}) {
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source(uri, options);
  if (!source) throw std::runtime_error(source.error().message);
  Read read;
  for (;;) {
    const Result<ReceivedSample> next = (*source)->next();
    if (!next && next.error().code == ErrorCode::kTimeout) continue;
    if (!next) break;
    read.samples.push_back(next->sample);
  }
  read.beams = (*source)->beams();
  read.sensor = (*source)->sensor();
  read.report = (*source)->report();
  return read;
}

std::string table_of(const Read& read) {
  std::string text = sample_table_head({.beams = read.beams, .sensor = read.sensor});
  StoreyId storey{};
  for (const RangeSample& sample : read.samples) append_sample_row(text, sample, storey);
  return text;
}

void expect_equal(const RangeSample& a, const RangeSample& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.measured_at, b.measured_at);
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.T_odom_body.vector(), b.T_odom_body.vector());
  EXPECT_EQ(a.starts_segment, b.starts_segment);
  EXPECT_EQ(a.odometry_ran_on, b.odometry_ran_on);
  EXPECT_EQ(a.storey, b.storey);
  EXPECT_EQ(a.beam_count, b.beam_count);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.status, b.status);
}

void expect_round_trip(const Read& written) {
  const TemporaryFile file("a.csv", table_of(written));
  const Read read = read_all(file.path());
  ASSERT_EQ(read.samples.size(), written.samples.size());
  for (std::size_t i = 0; i < read.samples.size(); ++i) expect_equal(read.samples[i], written.samples[i]);
  EXPECT_EQ(read.beams.count, written.beams.count);
  EXPECT_EQ(read.beams.bearing_rad, written.beams.bearing_rad);
  EXPECT_EQ(read.sensor.min_range_m, written.sensor.min_range_m);
  EXPECT_EQ(read.sensor.max_range_m, written.sensor.max_range_m);
  EXPECT_EQ(read.sensor.range_age, written.sensor.range_age);
  EXPECT_EQ(read.sensor.odometry.drift_yaw_per_metre_rad, written.sensor.odometry.drift_yaw_per_metre_rad);
  EXPECT_EQ(read.report.counters.hits, written.report.counters.hits);
  EXPECT_EQ(read.report.counters.segments, written.report.counters.segments);
  EXPECT_THAT(read.report.problems, IsEmpty());
}

TEST(SampleTable, ReadsTheSamplesOfAFlightBackAsTheyWere) {
  const Read flight = read_all("sim://office?seed=1");
  ASSERT_GT(flight.samples.size(), 1000U);
  expect_round_trip(flight);
}

TEST(SampleTable, KeepsTheStoreys) {
  RangeSample sample;
  sample.beam_count = 4;
  Read read{.samples = {5, sample}, .beams = BeamLayout::multiranger(), .sensor = {}, .report = {}};
  for (std::size_t i = 0; i < read.samples.size(); ++i) {
    read.samples[i].measured_at += Duration(i);
    read.samples[i].storey = make_id<StoreyId>(std::array<std::size_t, 5>{0, 1, 1, 0, 31}[i]);
  }
  const TemporaryFile file("a.csv", table_of(read));
  const Read back = read_all(file.path());
  ASSERT_EQ(back.samples.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(back.samples[i].storey, read.samples[i].storey) << i;
}

TEST(SampleTable, ReadsTheSamplesOfALaserLogBackAsTheyWere) {
  const TemporaryFile log("a.clf", flaser_line(180, 2, "10.15") + flaser_line(180, 3, "10.35"));
  const Read laser = read_all(log.path());
  ASSERT_EQ(laser.samples.size(), 2U);
  expect_round_trip(laser);
}

TEST(SampleTable, KeepsThatAVehiclesEstimateRanOn) {
  RangeSample sample;
  sample.starts_segment = true;
  sample.odometry_ran_on = true;
  sample.beam_count = 4;
  Read read{.samples = {sample, sample}, .beams = BeamLayout::multiranger(), .sensor = {}, .report = {}};
  read.samples[1].measured_at += Duration(1);
  const TemporaryFile file("a.csv", table_of(read));
  EXPECT_TRUE(read_all(file.path()).samples.at(1).odometry_ran_on);
}

const std::string kHead =
    "# swiftlet samples 1\n# sensor flow min_range_m=0.05 max_range_m=3 range_age_s=0.1\n"
    "# bearings_rad "
    "0,1.5\nstamp_ns,measured_at_ns,odom_x_m,odom_y_m,odom_yaw_rad,segment,range_0_m,range_1_m\n";

TEST(SampleTable, ClassifiesRangesByItsLimitsAndByNarrowerOnes) {
  const TemporaryFile file("a.csv", kHead + "10,5,1,2,0.5,0,2.5,inf\n20,6,1,2,0.5,0,0.01,nan\n");
  const Read usual = read_all(file.path());
  ASSERT_EQ(usual.samples.size(), 2U);
  EXPECT_TRUE(usual.samples[0].starts_segment) << "as any first sample";
  EXPECT_EQ(usual.samples[0].status[0], RangeStatus::kHit);
  EXPECT_EQ(usual.samples[0].distance_m[0], 2.5F);
  EXPECT_EQ(usual.samples[0].status[1], RangeStatus::kNoReturn);
  EXPECT_EQ(usual.samples[1].status[0], RangeStatus::kInvalid);
  EXPECT_EQ(usual.samples[1].status[1], RangeStatus::kInvalid);
  SampleSourceOptions narrow;
  narrow.max_range_m = 2.0;
  EXPECT_EQ(read_all(file.path(), narrow).samples[0].status[0], RangeStatus::kNoReturn);
}

TEST(SampleTable, IsKnownByItsFirstLineToo) {
  const TemporaryFile file("a.txt", kHead + "10,5,1,2,0.5,0,2.5,inf\n");
  EXPECT_EQ(read_all(file.path()).samples.size(), 1U);
}

TEST(SampleTable, AVehiclesClockMayBeginAnewWithASegment) {
  const TemporaryFile file("a.csv", kHead + "10,5,1,2,0.5,0,2.5,inf\n20,3,1,2,0.5,1,2.5,inf\n");
  EXPECT_EQ(read_all(file.path()).samples.size(), 2U);
}

TEST(SampleTable, ALeapOfTheDeadReckoningBeginsASegment) {
  const TemporaryFile file("a.csv", kHead +
                                        "0,0,1,2,0.5,0,2.5,inf\n"
                                        "100000000,100000000,3,2,0.5,0,2.5,inf\n"
                                        "200000000,200000000,500000,2,0.5,2,2.5,inf\n"
                                        "300000000,300000000,3.1,2,0.5,0,2.5,inf\n");
  const Read read = read_all(file.path());
  std::vector<bool> starts;
  for (const RangeSample& sample : read.samples) {
    starts.push_back(sample.starts_segment);
    EXPECT_FALSE(sample.odometry_ran_on);
  }
  EXPECT_THAT(starts, ElementsAre(true, false, true, true));
  EXPECT_EQ(read.report.counters.leaps, 2U);
  EXPECT_THAT(read.report.problems, IsEmpty());
}

TEST(SampleTable, SkipsEmptyLines) {
  const std::string row = "10,5,1,2,0.5,0,2.5,inf\n";
  const TemporaryFile file("a.csv", std::string(kHead).append(row).append("\n\r\n"));
  const Read read = read_all(file.path());
  EXPECT_EQ(read.samples.size(), 1U);
  EXPECT_THAT(read.report.problems, IsEmpty());
}

TEST(SampleTable, EndsAtARowThatCannotBeUsedAndNamesIt) {
  const std::string good = "10,5,1,2,0.5,0,2.5,inf\n";
  for (const auto& [row, fault] : std::vector<std::pair<std::string, std::string>>{
           {"20,6,1,2,0.5,0,2.5\n", "line 6: range_1_m cannot be ''"},
           {"20,6,1,2,0.5,0,2.5,inf,1\n", "line 6: what follows the last column cannot be '1'"},
           {"20,6,nan,2,0.5,0,2.5,inf\n", "line 6: odom_x_m cannot be 'nan'"},
           {"# storey 32\n", "line 6: a storey cannot be '32'"},
           {"# storeys\n", "line 6: stamp_ns cannot be '# storeys'"},
           {"20,6,1,2,0.5,3,2.5,inf\n", "line 6: segment cannot be '3'"},
           {"20,5,1,2,0.5,0,2.5,inf\n", "line 6: measured_at_ns does not increase"},
           {"20,4,1,2,0.5,2,2.5,inf\n", "line 6: measured_at_ns does not increase"},
           {"99999999999999999999,6,1,2,0.5,0,2.5,inf\n", "line 6: stamp_ns cannot be"},
           {"20,6,1,2,0.5,0,-1,inf\n", "line 6: range_0_m cannot be '-1'"},
           {"20,6,1,2,0.5,0,\x1b[2J\xff,inf\n", "line 6: range_0_m cannot be '?[2J?'"}}) {
    const TemporaryFile file("a.csv", std::string(kHead).append(good).append(row).append(good));
    const Read read = read_all(file.path());
    EXPECT_EQ(read.samples.size(), 1U) << row;
    EXPECT_THAT(read.report.problems, ElementsAre(HasSubstr(fault)));
  }
}

TEST(SampleTable, RefusesOtherTables) {
  for (const std::string& text :
       {std::string("1,2,3\n"), kHead.substr(0, 60),
        std::string("# swiftlet samples 1\n# sensor wings\n#\n\n"),
        std::string("# swiftlet samples 1\n# sensor flow min_range_m=3 max_range_m=2 range_age_s=0\n#\n\n"),
        kHead.substr(0, kHead.rfind(','))}) {
    const TemporaryFile file("a.csv", text);
    const auto source = open_sample_source(file.path(), {});
    ASSERT_FALSE(source.ok()) << text;
    EXPECT_THAT(source.error().message, HasSubstr("is no table of samples: "));
  }
}

}  // namespace
}  // namespace swiftlet
