// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/open_sample_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/firmware_link/laser_lines.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::vector<RangeSample> read_all(SampleSource& source) {
  std::vector<RangeSample> samples;
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (!received) return samples;
    samples.push_back(received->sample);
  }
}

std::string refusal(const std::string& uri, const SampleSourceOptions& options = {}) {
  const auto source = open_sample_source(uri, options);
  return source ? "opened" : source.error().message;
}

TEST(OpenSampleSource, DetectsCapturesAndLaserLogsByContent) {
  const TemporaryFile capture("flight");
  write_capture(capture.path(), SyntheticCapture{}.frames());
  for (const std::string& uri : {capture.path(), "replay:" + capture.path()}) {
    const auto source = open_sample_source(uri, {});
    ASSERT_TRUE(source.ok()) << source.error().message;
    EXPECT_EQ((*source)->beams().count, 4);
    EXPECT_EQ(read_all(**source).size(), 7U);
    EXPECT_EQ((*source)->progress(), 1.0);
  }
  const TemporaryFile laser("laser.txt", flaser_line(180, 0.0, "1"));
  const auto source = open_sample_source(laser.path(), {});
  ASSERT_TRUE(source.ok());
  EXPECT_EQ((*source)->beams().count, 11);
}

TEST(OpenSampleSource, ReadsTheDescriptionBesideACapture) {
  const TemporaryFile capture("flight.pcap");
  SyntheticCapture flight;
  flight.with_toc = false;
  write_capture(capture.path(), flight.frames());
  EXPECT_THAT(refusal(capture.path()), HasSubstr("describe them in " + capture.path() + ".toml"));
  const TemporaryFile description("flight.pcap.toml", R"([[block]]
id = 1
variables = [
  { name = "stateEstimate.x", type = "float" }, { name = "stateEstimate.y", type = "float" },
  { name = "stateEstimate.yaw", type = "float" }, { name = "range.front", type = "uint16" },
  { name = "range.left", type = "uint16" }, { name = "range.back", type = "uint16" },
  { name = "range.right", type = "uint16" } ]
)");
  const auto source = open_sample_source(capture.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ(read_all(**source).size(), 7U);
  EXPECT_THAT((*source)->report().notes, Contains(HasSubstr("taken from " + description.path())));
  description.write("[[block]]\nid = 1\n");
  EXPECT_THAT(refusal(capture.path()), HasSubstr(description.path() + ":1: a block needs variables"));
}

TEST(OpenSampleSource, MapsTheFirstVehicleOfACaptureThatCanBe) {
  const TemporaryFile capture("flight.pcap");
  SyntheticCapture on_the_desk;
  on_the_desk.packets = 1;
  const auto of = [](const SyntheticCapture& flight, std::uint8_t vehicle) {
    return capture_bytes(flight.frames(), radio_vehicle(vehicle)).substr(kPcapFileHeader);
  };
  const std::string desk = capture_bytes(on_the_desk.frames(), radio_vehicle(1));
  capture.write(desk + of(on_the_desk, 2) + of(SyntheticCapture{}, 3));
  const auto source = open_sample_source(capture.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_EQ(read_all(**source).size(), 7U);
  EXPECT_THAT(
      (*source)->report().notes,
      testing::ElementsAre(HasSubstr("follows radio E7E7E7E703 channel 80, leaves out radio E7E7E7E701"),
                           HasSubstr("follows radio E7E7E7E703 channel 80, leaves out radio E7E7E7E702")));
  capture.write(desk + of(on_the_desk, 2) + of(on_the_desk, 3));
  EXPECT_THAT(refusal(capture.path()),
              testing::AllOf(HasSubstr("never lie close enough in time"),
                             HasSubstr("(of radio E7E7E7E701 channel 80;"),
                             HasSubstr("either: radio E7E7E7E702 channel 80, radio E7E7E7E703 channel 80)")));
  capture.write(desk);
  EXPECT_THAT(refusal(capture.path()), testing::Not(HasSubstr("(of ")));
}

TEST(OpenSampleSource, UsesATruncatedCaptureUpToTheDamage) {
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture{}.frames());
  const std::string bytes = capture.read();
  capture.write(std::string_view(bytes).substr(0, bytes.size() - 5));
  const auto source = open_sample_source(capture.path(), {});
  ASSERT_TRUE(source.ok());
  EXPECT_EQ(read_all(**source).size(), 6U);
  ASSERT_EQ((*source)->report().problems.size(), 1U);
  EXPECT_THAT((*source)->report().problems[0], HasSubstr("damaged at byte "));
  capture.write(std::string_view(bytes).substr(0, 100));
  EXPECT_THAT(refusal(capture.path()), HasSubstr("it holds no sample"));
}

TEST(OpenSampleSource, AppliesOptionsAndReportsWhenOneHasNoEffect) {
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture{}.frames());
  SampleSourceOptions options;
  options.beam_count = 5;
  options.range_age = Duration::zero();
  options.max_range_m = 1.0;
  options.min_range_m = 0.2;
  const auto source = open_sample_source(capture.path(), options);
  ASSERT_TRUE(source.ok());
  EXPECT_THAT((*source)->report().notes, Contains(HasSubstr("--beams is ignored")));
  const std::vector<RangeSample> samples = read_all(**source);
  EXPECT_EQ(samples.size(), 8U);
  EXPECT_EQ(samples[0].status[0], RangeStatus::kNoReturn);
  EXPECT_EQ((*source)->sensor().max_range_m, 1.0);
  EXPECT_EQ((*source)->sensor().min_range_m, 0.2);
}

TEST(OpenSampleSource, NotesThatTablesHaveBeamsOfTheirOwn) {
  const TemporaryFile samples(
      "samples.csv",
      "# swiftlet samples 1\n# sensor flow min_range_m=0.05 max_range_m=3 range_age_s=0.1\n"
      "# bearings_rad 0,1.5\n"
      "stamp_ns,measured_at_ns,odom_x_m,odom_y_m,odom_yaw_rad,segment,range_0_m,range_1_m\n");
  const TemporaryFile flight("flight.csv", "# block,host_time_s,device_ms\n");
  for (const std::string& path : {samples.path(), flight.path()}) {
    const auto plain = open_sample_source(path, {});
    ASSERT_TRUE(plain.ok()) << plain.error().message;
    EXPECT_TRUE((*plain)->report().notes.empty());
    SampleSourceOptions options;
    options.beam_count = 5;
    const auto source = open_sample_source(path, options);
    ASSERT_TRUE(source.ok()) << source.error().message;
    EXPECT_THAT((*source)->report().notes, testing::ElementsAre(HasSubstr("--beams is ignored")));
  }
}

TEST(OpenSampleSource, RefusesImpossibleOptions) {
  for (const int beams : {-1, 0, 1, 65}) {
    SampleSourceOptions options;
    options.beam_count = beams;
    EXPECT_THAT(refusal("a.clf", options),
                HasSubstr("--beams " + std::to_string(beams) + ": must be from 2 to 64"));
  }
  SampleSourceOptions age;
  for (const int seconds : {-1, 2}) {
    age.range_age = std::chrono::seconds(seconds);
    EXPECT_THAT(refusal("a.clf", age), HasSubstr("s: must be from -0.25 to 1 s"));
  }
  SampleSourceOptions range;
  range.max_range_m = 0.0;
  EXPECT_THAT(refusal("a.clf", range), HasSubstr("maximum range"));
}

TEST(OpenSampleSource, RefusesLimitsThatLeaveNoRange) {
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture{}.frames());
  SampleSourceOptions far;
  far.min_range_m = 4.0;  // beyond what the vehicle's sensors reach, but not a laser scanner
  EXPECT_THAT(refusal(capture.path(), far), HasSubstr("minimum range 4.000000 m: must be less than the "
                                                      "maximum, here 3.000000 m"));
  EXPECT_THAT(refusal("sim://office", far), HasSubstr("minimum range"));
  EXPECT_THAT(refusal("udp://127.0.0.1:19850", far), HasSubstr("minimum range"));
  const TemporaryFile log("room.clf", "nothing of use\n");
  EXPECT_THAT(refusal(log.path(), far), testing::Not(HasSubstr("minimum range")));
  SampleSourceOptions near;
  near.max_range_m = 0.05;  // the least of both sensors
  EXPECT_THAT(refusal(capture.path(), near), HasSubstr("minimum range"));
  EXPECT_THAT(refusal(log.path(), near), HasSubstr("minimum range"));
}

TEST(OpenSampleSource, RefusesAnInvalidInputWithOneLine) {
  const TemporaryFile empty("empty.pcap", "");
  const TemporaryFile text("notes.txt", "nothing of use\n");
  const TemporaryFile fake("fake.pcap", "not a capture, only called so");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"/nonexistent/flight.pcap", "/nonexistent/flight.pcap: no such file"},
      {testing::TempDir(), "is a directory"},
      {empty.path(), "is empty"},
      {text.path(), "neither a capture (pcap) nor a table (.csv) nor a CARMEN laser log"},
      {fake.path(), "not a classic pcap"},
      {"http://example.org/a.pcap", "unknown scheme 'http'"},
      {"sim://nowhere", "nowhere"},
  };
  for (const auto& [uri, expected] : cases) {
    EXPECT_THAT(refusal(uri), HasSubstr(expected));
    EXPECT_EQ(refusal(uri).find('\n'), std::string::npos);
  }
}

TEST(OpenSampleSource, DoesNotRecordAFlightWhoseFaultsARecordingWouldNotHave) {
  struct Nowhere final : FrameSink {
    void take(const LinkFrame& /*frame*/) noexcept override {}
  } nowhere;
  SampleSourceOptions options;
  options.recording = &nowhere;
  EXPECT_TRUE(open_sample_source("sim://office", options).ok());
  const auto source = open_sample_source("sim://office?fault=restart@20:10", options);
  ASSERT_FALSE(source.ok());
  EXPECT_THAT(source.error().message, HasSubstr("convert it to a table (.csv)"));
}

TEST(OpenSampleSource, NamesTheKindOfABuildingDrawnAtRandom) {
  const auto source = open_sample_source("sim://building?seed=3", {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  EXPECT_THAT((*source)->report().notes, testing::Contains(testing::StartsWith("kind of building: ")));
}

TEST(OpenSampleSource, FliesASimulatedVehicleWithItsTruth) {
  const auto source = open_sample_source("sim://office?seed=1", {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  std::vector<RangeSample> samples;
  Result<ReceivedSample> received = (*source)->next();
  for (; received || received.error().code == ErrorCode::kTimeout; received = (*source)->next())
    if (received) samples.push_back(received->sample);
  EXPECT_EQ(received.error().code, ErrorCode::kEndOfRecording) << received.error().message;
  const InputReport& report = (*source)->report();
  ASSERT_GT(samples.size(), 1000U);
  EXPECT_EQ(report.counters.segments, 1U);
  EXPECT_GT(report.counters.gaps, 0U);  // one packet in a hundred is lost
  EXPECT_GT(samples.size(), report.counters.range_packets * 95 / 100);
  EXPECT_EQ(report.counters.range_packets, samples.size() + report.counters.unpaired);
  EXPECT_TRUE(report.problems.empty());
  EXPECT_EQ((*source)->progress(), 1.0);
  const std::vector<StampedPose> truth = (*source)->ground_truth();
  ASSERT_EQ(truth.size(), samples.size());
  // Dead reckoning drifts slowly: over one second it agrees with the truth.
  for (std::size_t i = 10; i < samples.size(); i += 10) {
    EXPECT_EQ(truth[i].stamp, samples[i].stamp);
    const Pose2 reckoned = between(samples[i - 10].T_odom_body, samples[i].T_odom_body);
    const Pose2 error = between(between(truth[i - 10].pose, truth[i].pose), reckoned);
    EXPECT_LT(std::hypot(error.x_m(), error.y_m()), 0.5) << "sample " << i;
    EXPECT_LT(std::abs(error.yaw_rad()), 0.2) << "sample " << i;
  }
}

TEST(OpenSampleSource, FliesTheSameFlightForTheSameSeedOnly) {
  const auto first_distances = [](const std::string& uri) {
    const auto source = open_sample_source(uri, {});
    std::vector<float> distances;
    for (int calls = 0; source && calls < 5000 && distances.size() < 800; ++calls)
      if (const auto received = (*source)->next())
        distances.insert(distances.end(), received->sample.distance_m.begin(),
                         received->sample.distance_m.begin() + 4);
    return distances;
  };
  EXPECT_EQ(first_distances("sim://loop?seed=3").size(), 800U);
  EXPECT_EQ(first_distances("sim://loop?seed=3"), first_distances("sim://loop?seed=3"));
  EXPECT_NE(first_distances("sim://loop?seed=3"), first_distances("sim://loop?seed=4"));
}

struct ReferenceFlight {
  const char* name;
  std::uint64_t range_packets;
  std::uint64_t unpaired;
};

class RealFlight : public testing::TestWithParam<ReferenceFlight> {};

TEST_P(RealFlight, IsOneUnbrokenRunOfSamples) {
  const std::string path = reference_file("flights/" + std::string(GetParam().name) + ".pcap");
  SWIFTLET_REQUIRE_REFERENCE(path);
  const auto source = open_sample_source(path, {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = read_all(**source);
  const InputReport& report = (*source)->report();
  EXPECT_EQ(report.counters.range_packets, GetParam().range_packets);
  // At the start ranges are measured before there is any dead reckoning.
  EXPECT_EQ(report.counters.unpaired, GetParam().unpaired);
  EXPECT_EQ(samples.size(), GetParam().range_packets - GetParam().unpaired);
  EXPECT_EQ(report.counters.segments, 1U);
  EXPECT_EQ(report.counters.gaps + report.counters.duplicates + report.counters.out_of_order, 0U);
  EXPECT_TRUE(report.problems.empty());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_LT(samples[i - 1].measured_at, samples[i].measured_at);
    const Pose2 step = between(samples[i - 1].T_odom_body, samples[i].T_odom_body);
    EXPECT_LT(std::hypot(step.x_m(), step.y_m()), 0.35);
    EXPECT_LT(std::abs(step.yaw_rad()), 0.25);
  }
}

INSTANTIATE_TEST_SUITE_P(Flights, RealFlight,
                         testing::Values(ReferenceFlight{"olsson", 3818, 2},
                                         ReferenceFlight{"rice", 3150, 1}),
                         [](const auto& flight) { return std::string(flight.param.name); });

}  // namespace
}  // namespace swiftlet
