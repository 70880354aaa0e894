// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/carmen_sample_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/firmware_link/laser_lines.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<RangeSample> read_all(SampleSource& source) {
  std::vector<RangeSample> samples;
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (!received) {
      EXPECT_EQ(received.error().code, ErrorCode::kEndOfRecording);
      return samples;
    }
    samples.push_back(received->sample);
  }
}

TEST(CarmenSampleSource, TakesOdometryLinesAtTheTimeOfTheRangesWhenTheirStampsAreGood) {
  const TemporaryFile file("a.clf", odometry_line(0, 0, 0, "10.0") + flaser_line(180, 7, "10.15") +
                                        odometry_line(0.1, 0, 0.2, "10.1") + flaser_line(180, 7, "10.2") +
                                        odometry_line(0.2, 0, 0.4, "10.2"));
  const auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_NEAR(samples[0].T_odom_body.x_m(), 0.05, 1e-9);
  EXPECT_NEAR(samples[0].T_odom_body.yaw_rad(), 0.1, 1e-9);
  EXPECT_NEAR(samples[1].T_odom_body.x_m(), 0.1, 1e-9);
  EXPECT_EQ(samples[0].stamp, HostTime(std::chrono::milliseconds(10'150)));
  EXPECT_EQ((*source)->sensor().range_age, std::chrono::milliseconds(100));
  EXPECT_THAT((*source)->report().notes, ElementsAre(HasSubstr("from the ODOM lines, 100 ms before")));
  EXPECT_TRUE((*source)->report().shows_age);
  EXPECT_EQ((*source)->progress(), 1.0);
}

TEST(CarmenSampleSource, LosesNoScanOfAFastLaserThatWaitsForTheNextOdometryLine) {
  constexpr int kScans = 800;
  std::string text;
  for (int i = 0; i < kScans; ++i) {
    if (i % 100 == 0) text += odometry_line(0.001 * i, 0, 0, std::to_string(10 + i / 100));
    text += scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", std::to_string(10.2 + 0.01 * i));
  }
  for (const char* stamp : {"18", "19"}) text += odometry_line(0.8, 0, 0, stamp);
  const TemporaryFile file("a.clf", text);
  for (const Duration age : {Duration(std::chrono::milliseconds(100)), kMinRangeAge}) {
    SampleSourceOptions options;
    options.beam_count = 3;
    options.range_age = age;
    const auto source = CarmenSampleSource::open(file.path(), options);
    ASSERT_TRUE(source.ok());
    EXPECT_EQ(read_all(**source).size(), kScans) << to_seconds(age);
    EXPECT_EQ((*source)->report().counters.unpaired, 0U) << to_seconds(age);
    EXPECT_THAT((*source)->report().notes, ElementsAre(HasSubstr("from the ODOM lines")));
  }
}

TEST(CarmenSampleSource, RawScansTakeTheirPosesFromTheOdometryLines) {
  const std::string scan = scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", "10.2");
  const TemporaryFile file("a.clf", odometry_line(0, 0, 0, "10.0") + scan + odometry_line(0.2, 0, 0, "10.2"));
  SampleSourceOptions options;
  options.beam_count = 3;
  const auto source = CarmenSampleSource::open(file.path(), options);
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(samples[0].T_odom_body.x_m(), 0.1, 1e-9);
  const TemporaryFile alone("b.clf", scan);
  EXPECT_THAT(CarmenSampleSource::open(alone.path(), options).error().message,
              HasSubstr("RAWLASER1 lines have no poses"));
}

TEST(CarmenSampleSource, BeginsAgainWithAnotherAgeAsIfItWereOpenedSo) {
  const TemporaryFile file("a.clf", odometry_line(0, 0, 0, "10.0") + flaser_line(180, 7, "10.15") +
                                        odometry_line(0.1, 0, 0.2, "10.1") + flaser_line(180, 7, "10.2") +
                                        odometry_line(0.2, 0, 0.4, "10.2"));
  SampleSourceOptions options;
  options.max_range_m = 5.0;
  const auto usual = CarmenSampleSource::open(file.path(), options);
  ASSERT_TRUE(usual.ok());
  const std::vector<RangeSample> before = read_all(**usual);
  const std::unique_ptr<SampleSource> again = (*usual)->again(std::chrono::milliseconds(50));
  options.range_age = std::chrono::milliseconds(50);
  const auto opened = CarmenSampleSource::open(file.path(), options);
  ASSERT_TRUE(again && opened.ok());
  const std::vector<RangeSample> samples = read_all(*again);
  const std::vector<RangeSample> expected = read_all(**opened);
  ASSERT_EQ(samples.size(), expected.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].T_odom_body.x_m(), expected[i].T_odom_body.x_m());
    EXPECT_EQ(samples[i].status, expected[i].status);
  }
  EXPECT_NE(samples[0].T_odom_body.x_m(), before[0].T_odom_body.x_m());
  EXPECT_EQ(again->report().notes, (*opened)->report().notes);
  EXPECT_EQ(again->sensor().max_range_m, 5.0);
}

TEST(CarmenSampleSource, TakesThePoseInTheScanWhenOdometryStampsGoBack) {
  const TemporaryFile file("a.clf", odometry_line(0, 0, 0, "10.0") + flaser_line(180, 7, "10.15") +
                                        odometry_line(0.1, 0, 0.2, "10.3") +
                                        odometry_line(0.2, 0, 0.4, "10.2"));
  const auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_DOUBLE_EQ(samples[0].T_odom_body.x_m(), 7.0);
  EXPECT_EQ((*source)->sensor().range_age, Duration::zero());
  EXPECT_THAT((*source)->report().notes, ElementsAre(HasSubstr("go back 1 times")));
  EXPECT_FALSE((*source)->report().shows_age) << "one stamp for scan and pose";
}

TEST(CarmenSampleSource, TakesThePoseInTheScanWhenThereIsNoOdometryOrTooLittle) {
  const TemporaryFile none("a.clf", flaser_line(180, 7, "10.15"));
  EXPECT_THAT((*CarmenSampleSource::open(none.path(), {}))->report().notes,
              ElementsAre(HasSubstr("no ODOM lines")));
  const TemporaryFile few("b.clf", odometry_line(0, 0, 0, "10") + odometry_line(0, 0, 0, "11") +
                                       flaser_line(180, 7, "10.15") + flaser_line(180, 7, "90"));
  EXPECT_THAT((*CarmenSampleSource::open(few.path(), {}))->report().notes,
              ElementsAre(HasSubstr("do not span")));
}

TEST(CarmenSampleSource, TakesThePoseInTheScanWhenOdometryLinesShareStampsOrHaveHoles) {
  std::string whole_seconds;
  std::string holes;
  for (int i = 0; i < 400; ++i) {
    const std::string stamp = std::to_string(10.0 + 0.1 * i);
    const std::string scan = flaser_line(180, 7, stamp);
    whole_seconds += odometry_line(0, 0, 0, std::to_string(10 + i / 10)) + scan;
    holes += (i / 20 % 2 == 0 || i == 399 ? odometry_line(0, 0, 0, stamp) : "") + scan;
  }
  whole_seconds += odometry_line(0, 0, 0, "50");
  const auto note_of = [](const std::string& text) {
    const TemporaryFile file("a.clf", text);
    return (*CarmenSampleSource::open(file.path(), {}))->report().notes.at(0);
  };
  EXPECT_THAT(note_of(whole_seconds), HasSubstr("from the FLASER lines: many ODOM lines have the stamp"));
  EXPECT_THAT(note_of(holes), HasSubstr("from the FLASER lines: the ODOM lines do not span"));
}

TEST(CarmenSampleSource, TakesThePoseInTheScanWhenItTellsMoreThanTheOdometryLines) {
  std::string sparse;
  std::string whole_seconds;
  for (int i = 0; i <= 40; ++i) {
    const std::string stamp = std::to_string(10.0 + 0.1 * i);
    const std::string odometry = odometry_line(0.1 * i, 7.0, 0.0, stamp);
    if (i % 5 == 0) sparse += odometry;
    sparse += flaser_line(180, 0.1 * i, stamp);
    whole_seconds += odometry + flaser_line(180, 0.1 * i, std::to_string(10 + i / 10), 1.0 + 0.01 * i);
  }
  for (const auto& [text, note] :
       {std::pair{sparse, "there are few ODOM lines"},
        std::pair{whole_seconds, "many of them have the stamp of the line before"}}) {
    const TemporaryFile file("a.clf", text);
    const auto source = CarmenSampleSource::open(file.path(), {});
    ASSERT_TRUE(source.ok()) << note;
    EXPECT_THAT((*source)->report().notes, ElementsAre(HasSubstr(note)));
    for (const RangeSample& sample : read_all(**source)) EXPECT_NEAR(sample.T_odom_body.y_m(), 0.2, 1e-9);
  }
}

TEST(CarmenSampleSource, BeginsASegmentWhereTheWheelsAreReset) {
  std::string text = "ODOM 0 0 0 0 0 0 0.9 h 0.9\n";
  for (int i = 0; i < 9; ++i) text += flaser_line(180, 0.1 * i, std::to_string(1.0 + 0.2 * i));
  const std::string zero = flaser_line(180, 0.0, "3.0");
  const std::string pose = "0.000000 0.2 0.3";
  text += std::string(zero).replace(zero.find(pose), pose.size(), "0 0 0.0000");
  text += flaser_line(180, 0.1, "3.2");
  const TemporaryFile file("a.clf", text);
  auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 11U);
  EXPECT_TRUE(samples[9].starts_segment);
  EXPECT_FALSE(samples[9].odometry_ran_on);
  EXPECT_EQ((*source)->report().counters.segments, 2U);
}

TEST(CarmenSampleSource, BeginsASegmentWhereTheWheelsAreResetAndTheLaserIsNotOnTheirAxle) {
  const auto line = [](const std::string& poses, const std::string& stamp) {
    return scan_line("ROBOTLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0 " + poses + " 0 0 0 0 0", stamp);
  };
  const TemporaryFile file("a.clf", line("1.2 1.0 1.5708 1.2 0.8 1.5708", "10.0") +
                                        line("1.2 1.1 1.5708 1.2 0.9 1.5708", "10.2") +
                                        line("0.2 0 0 0 0 0", "70.0") + line("0.3 0 0 0.1 0 0", "70.2"));
  SampleSourceOptions options;
  options.beam_count = 2;
  auto source = CarmenSampleSource::open(file.path(), options);
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_TRUE(samples[2].starts_segment);
  EXPECT_FALSE(samples[2].odometry_ran_on);
  EXPECT_EQ((*source)->report().counters.segments, 2U);
}

/// Of the samples from lines with these stamps and positions, in their order.
std::vector<double> positions_of(const std::vector<const char*>& stamps, const std::vector<double>& x_m,
                                 std::vector<std::string>* notes = nullptr) {
  std::string text;
  for (std::size_t i = 0; i < stamps.size(); ++i) text += flaser_line(180, x_m[i], stamps[i]);
  const TemporaryFile file("a.clf", text);
  const auto source = CarmenSampleSource::open(file.path(), {});
  std::vector<double> found_m;
  for (const RangeSample& sample : read_all(**source)) found_m.push_back(sample.T_odom_body.x_m());
  if (notes != nullptr) *notes = (*source)->report().notes;
  EXPECT_TRUE((*source)->report().problems.empty());
  return found_m;
}

TEST(CarmenSampleSource, ScansFollowTheirPosesWhereStampsStepBack) {
  const std::vector<double> ahead{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  std::vector<std::string> notes;
  EXPECT_EQ(positions_of({"0", "1", "2", "3", "4", "2.5", "3.5", "5"}, ahead, &notes), ahead);
  EXPECT_THAT(notes,
              ElementsAre(HasSubstr("no ODOM lines"), HasSubstr("as in the file, not by their stamps (1 ")));
  EXPECT_EQ(positions_of({"100", "101", "102", "103", "40", "41", "42", "43"}, ahead), ahead) << "set back";
  EXPECT_EQ(
      positions_of({"0", "1", "2", "4", "3", "5", "6", "7"}, {0, 0.1, 0.2, 0.4, 0.3, 0.5, 0.6, 0.7}, &notes),
      ahead)
      << "two lines are in the wrong place";
  EXPECT_THAT(notes, ElementsAre(HasSubstr("no ODOM lines"), HasSubstr("were sorted (1 ")));
}

TEST(CarmenSampleSource, TellsOfAClockThatStepsFarBack) {
  const TemporaryFile file("a.clf", flaser_line(180, 0, "100") + flaser_line(180, 0.1, "101") +
                                        flaser_line(180, 0, "40") + flaser_line(180, 0, "41"));
  const auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  EXPECT_THAT((*source)->report().problems, ElementsAre(HasSubstr("steps back by 61 s")));
}

TEST(CarmenSampleSource, TakesTheScannersOwnRangeWhereItIsLess) {
  const auto range_of = [](const std::string& max_range, std::optional<double> limit_m) {
    const TemporaryFile file("a.clf", scan_line("ROBOTLASER1", "0 -1.5 3.0 0.5 " + max_range + " 0.1 0 7", 7,
                                                "0 1 2 3 1 2 3 0 0 0 0 0", "10.5"));
    SampleSourceOptions options;
    options.beam_count = 2;
    options.max_range_m = limit_m;
    return (*CarmenSampleSource::open(file.path(), options))->sensor().max_range_m;
  };
  EXPECT_DOUBLE_EQ(range_of("4.1", {}), 4.09);
  EXPECT_EQ(range_of("30", {}), 5.0);
  EXPECT_EQ(range_of("0", {}), 5.0);
  EXPECT_DOUBLE_EQ(range_of("30", 40.0), 29.99);
}

TEST(CarmenSampleSource, AScannersGreatestReadingIsNoReturn) {
  for (const char* most : {"4.095", "4.1", "8.19", "30"}) {
    const std::string readings =
        std::string("0 -1.5 3.0 1.5 ") + most + " 0.1 0 3 " + most + " " + most + " 1.5";
    const TemporaryFile file("a.clf",
                             "ROBOTLASER1 " + readings + " 0 1 2 3 1 2 3 0 0 0 0 0 10.5 host 10.5\n");
    SampleSourceOptions options;
    options.beam_count = 3;
    options.max_range_m = 60.0;
    const auto source = CarmenSampleSource::open(file.path(), options);
    ASSERT_TRUE(source.ok()) << source.error().message;
    const std::vector<RangeSample> samples = read_all(**source);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].status[0], RangeStatus::kNoReturn) << most;
    EXPECT_EQ(samples[0].status[2], RangeStatus::kHit) << most;
  }
}

/// A scanner that turns to and fro before a wall of slanting steps; each line has the pose of the next one.
std::string lines_with_the_next_pose(double interval_s) {
  std::string text;
  const auto reading_at = [](int line) { return static_cast<int>(std::lround(12.0 * std::sin(0.8 * line))); };
  for (int line = 0; line < 300; ++line) {
    text += "FLASER 180";
    for (int i = 0; i < 180; ++i) text += (i + reading_at(line)) / 9 % 2 == 0 ? " 2.0" : " 3.5";
    const double yaw_rad = radians(reading_at(line + 1));
    const std::string stamp = std::to_string(100.0 + interval_s * line);
    text.append(" 9 9 9 0 0 ").append(std::to_string(yaw_rad)).append(" ").append(stamp);
    text.append(" host ").append(stamp).append("\n");
  }
  return text;
}

TEST(CarmenSampleSource, TakesRangesForOneLineOlderIfTheScansTurnWithThePosesOfTheLineBefore) {
  const TemporaryFile file("a.clf", lines_with_the_next_pose(0.25));
  const auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  EXPECT_EQ((*source)->sensor().range_age, std::chrono::milliseconds(250));
  EXPECT_THAT((*source)->report().notes,
              ElementsAre(HasSubstr("no ODOM lines"), HasSubstr("ranges taken for 250 ms older")));
  EXPECT_THAT((*source)->again(std::chrono::milliseconds(260))->report().notes,
              ElementsAre(HasSubstr("no ODOM lines"), HasSubstr("ranges taken for 260 ms older")))
      << "calibrated";
  const TemporaryFile slow("b.clf", lines_with_the_next_pose(1.5));
  EXPECT_EQ((*CarmenSampleSource::open(slow.path(), {}))->sensor().range_age, kMaxRangeAge);
  SampleSourceOptions options;
  options.range_age = Duration::zero();
  EXPECT_EQ((*CarmenSampleSource::open(file.path(), options))->sensor().range_age, Duration::zero());
}

TEST(CarmenSampleSource, TellsOnceOfBreaksAndOfALogWithoutAnyReturn) {
  std::string text;
  for (int i = 0; i < 9; ++i)  // carried off, twice
    text += flaser_line(180, i < 3 ? 0.1 * i : i < 6 ? 50.0 : -50.0, std::to_string(1.0 + 0.2 * i), 30.0);
  const TemporaryFile file("a.clf", text);
  auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  EXPECT_EQ(read_all(**source).size(), 9U);
  EXPECT_FALSE((*source)->next().ok());
  EXPECT_THAT((*source)->report().notes,
              ElementsAre(HasSubstr("no ODOM lines"), HasSubstr("breaks in the dead reckoning: 2"),
                          HasSubstr("no range is a return (")));
}

TEST(CarmenSampleSource, CapsRangesAndPicksBeams) {
  const TemporaryFile file("a.clf", flaser_line(180, 0, "1", 4.0));
  SampleSourceOptions options;
  options.beam_count = 4;
  auto source = CarmenSampleSource::open(file.path(), options);
  ASSERT_TRUE(source.ok());
  EXPECT_EQ((*source)->beams().count, 4);
  const RangeSample sample = read_all(**source).at(0);
  EXPECT_EQ(sample.beam_count, 4);
  EXPECT_EQ(sample.status[1], RangeStatus::kHit);  // 4.6 m
  EXPECT_EQ(sample.status[2], RangeStatus::kNoReturn);
  options.max_range_m = 4.5;
  source = CarmenSampleSource::open(file.path(), options);
  EXPECT_EQ(read_all(**source).at(0).status[1], RangeStatus::kNoReturn);
}

TEST(CarmenSampleSource, AcceptsARobotThatStandsStillAndScansOfOneStamp) {
  const TemporaryFile file("a.clf", flaser_line(180, 0, "1", 1.0) + flaser_line(180, 0, "1", 2.0) +
                                        flaser_line(180, 0, "1", 2.0) + flaser_line(180, 0, "1.00001", 2.0));
  auto source = CarmenSampleSource::open(file.path(), {});
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0].stamp, samples[1].stamp);
  EXPECT_LT(samples[0].measured_at, samples[1].measured_at);
  EXPECT_EQ((*source)->report().counters.duplicates, 1U);
  EXPECT_EQ((*source)->report().counters.segments, 1U);
}

struct ReferenceLog {
  const char* name;
  std::size_t scans;
  const char* note;
};

class ReferenceLaserLog : public testing::TestWithParam<ReferenceLog> {};

TEST_P(ReferenceLaserLog, DeliversEveryScanStampedAsTheRelationsStampIt) {
  const std::string log = reference_file("radish/" + std::string(GetParam().name) + ".clf.gz");
  const std::string relations = reference_file("radish/" + std::string(GetParam().name) + ".relations");
  SWIFTLET_REQUIRE_REFERENCE(log);
  SWIFTLET_REQUIRE_REFERENCE(relations);
  const auto start = std::chrono::steady_clock::now();
  const auto source = CarmenSampleSource::open(log, {});
  ASSERT_TRUE(source.ok());
  const std::vector<RangeSample> samples = read_all(**source);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(samples.size(), GetParam().scans);
  EXPECT_EQ((*source)->report().counters.segments, 1U);
  EXPECT_THAT((*source)->report().notes, testing::Contains(HasSubstr(GetParam().note)));
  EXPECT_TRUE((*source)->report().problems.empty());

  std::set<std::int64_t> stamps_us;
  for (const RangeSample& sample : samples)
    stamps_us.insert(std::chrono::floor<std::chrono::microseconds>(sample.stamp.time_since_epoch()).count());
  std::ifstream file(relations);
  std::string line;
  std::size_t matched = 0;
  std::size_t total = 0;
  while (std::getline(file, line)) {
    double t1 = 0.0;
    double t2 = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf %lf", &t1, &t2), 2);
    for (const double t : {t1, t2}) {
      const std::int64_t us = std::llround(t * 1e6);
      const auto near = stamps_us.lower_bound(us - 10);
      ++total;
      if (near != stamps_us.end() && *near <= us + 10) ++matched;
    }
  }
  EXPECT_GT(total, 0U);
  EXPECT_EQ(matched, total);
}

INSTANTIATE_TEST_SUITE_P(Radish, ReferenceLaserLog,
                         testing::Values(ReferenceLog{"aces", 7374, "from the ODOM lines"},
                                         ReferenceLog{"intel", 13631, "go back 602 times"},
                                         ReferenceLog{"mit-killian", 17478, "439 ms older"}),
                         [](const auto& log) {
                           std::string name = log.param.name;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace swiftlet
