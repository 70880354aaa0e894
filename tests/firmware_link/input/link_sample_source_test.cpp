// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/link_sample_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "firmware_link/capture/followed_link.hpp"
#include "tests/firmware_link/distant_link.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"
#include "tests/firmware_link/scripted_clock.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Replays frames, then returns an error.
class FrameLink final : public Link {
 public:
  FrameLink(std::vector<LinkFrame> frames, Error end) : frames_(std::move(frames)), end_(std::move(end)) {}
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    if (next_ == frames_.size()) return end_;
    return frames_[next_++];
  }
  Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }

 private:
  std::vector<LinkFrame> frames_;
  Error end_;
  std::size_t next_ = 0;
};

LinkInput input_of(std::vector<LinkFrame> frames, Error end = {ErrorCode::kEndOfRecording, "end"}) {
  LinkInput input;
  input.name = "flight.pcap";
  input.link = std::make_unique<FrameLink>(std::move(frames), std::move(end));
  return input;
}

std::vector<RangeSample> read_all(LinkSampleSource& source) {
  std::vector<RangeSample> samples;
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (received) samples.push_back(received->sample);
    if (!received && received.error().code != ErrorCode::kTimeout) return samples;
  }
}

TEST(LinkSampleSource, TurnsFramesIntoSamples) {
  SyntheticCapture capture;
  LinkSampleSource source(input_of(capture.frames()));
  const std::vector<RangeSample> samples = read_all(source);
  ASSERT_EQ(samples.size(), 7U);  // the first packet's ranges are older than the flight
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].measured_at, device_ms(1000 + 100 * static_cast<int>(i)));
    EXPECT_EQ(samples[i].stamp, capture.data(static_cast<int>(i) + 1).at);
    EXPECT_NEAR(samples[i].T_odom_body.x_m(), 0.05 * static_cast<double>(i), 1e-6);
    EXPECT_FLOAT_EQ(samples[i].distance_m[0], 1.95F - 0.05F * static_cast<float>(i));
    EXPECT_FLOAT_EQ(samples[i].distance_m[1], 0.7F);
    EXPECT_EQ(samples[i].status[2], RangeStatus::kNoReturn);
    EXPECT_EQ(samples[i].status[3], RangeStatus::kInvalid);
  }
  EXPECT_EQ(source.report().counters.frames, capture.frames().size());
  EXPECT_EQ(source.report().counters.unpaired, 1U);
  EXPECT_TRUE(source.report().problems.empty());
  EXPECT_EQ(source.beams().count, 4);
}

TEST(LinkSampleSource, ContinuesWhenTheDeviceClockWraps) {
  SyntheticCapture capture;
  capture.packets = 40;
  capture.first_ms = 0xFFFFFF - 1950;
  LinkSampleSource source(input_of(capture.frames()));
  EXPECT_EQ(read_all(source).size(), 39U);
  EXPECT_EQ(source.report().counters.segments, 1U);
  EXPECT_EQ(source.report().counters.gaps, 0U);
}

TEST(LinkSampleSource, CountsLostAndRepeatedPackets) {
  SyntheticCapture capture;
  std::vector<LinkFrame> frames = capture.handshake();
  for (const int i : {0, 1, 2, 2, 3, 6, 5, 7, 8, 9}) frames.push_back(capture.data(i));
  LinkSampleSource source(input_of(frames));
  EXPECT_EQ(read_all(source).size(), 6U);
  EXPECT_EQ(source.report().counters.duplicates, 1U);
  EXPECT_EQ(source.report().counters.out_of_order, 1U);
  EXPECT_EQ(source.report().counters.gaps, 1U);
  EXPECT_EQ(source.report().counters.missing_packets, 2U);
  EXPECT_EQ(source.report().counters.segments, 1U);
}

TEST(LinkSampleSource, DeliversWhatPrecedesDamageAndReportsIt) {
  LinkSampleSource source(input_of(SyntheticCapture{}.frames(), {ErrorCode::kDamaged, "damaged at byte 77"}));
  EXPECT_EQ(read_all(source).size(), 7U);
  EXPECT_EQ(source.next().error().code, ErrorCode::kEndOfRecording);
  EXPECT_THAT(source.report().problems, ElementsAre("damaged at byte 77"));
}

TEST(LinkSampleSource, ReportsALostDevice) {
  LinkSampleSource source(input_of(SyntheticCapture{}.frames(), {ErrorCode::kNotFound, "unplugged"}));
  EXPECT_EQ(read_all(source).size(), 7U);
  EXPECT_EQ(source.next().error().code, ErrorCode::kNotFound);
}

TEST(LinkSampleSource, ALiveLinkThatNeverYieldsASampleDoesNotBlockItsCaller) {
  SyntheticCapture capture;
  capture.packets = 1000;
  std::vector<LinkFrame> frames = capture.frames();
  for (LinkFrame& frame : frames)
    if (frame.direction == LinkDirection::kToVehicle) frame.bytes[1] = 0;  // so that no block is known
  LinkInput input = input_of(std::move(frames));
  input.clock = std::make_shared<ManualLinkClock>();
  LinkSampleSource source(std::move(input));
  const Result<ReceivedSample> received = source.next();
  ASSERT_FALSE(received.ok());
  EXPECT_EQ(received.error().code, ErrorCode::kTimeout);
  EXPECT_LT(source.report().counters.frames, 500U);
}

TEST(LinkSampleSource, AFollowedCaptureThatYieldsNoSampleDoesNotBlockItsCaller) {
  SyntheticCapture capture;
  capture.packets = 1000;
  capture.with_toc = false;
  const TemporaryFile file("followed.pcap");
  write_capture(file.path(), capture.frames());
  LinkInput input;
  input.name = file.path();
  input.link = FollowedLink::open(file.path()).value();
  LinkSampleSource source(std::move(input));
  for (const std::uint64_t at_most : {256U, 512U}) {
    const Result<ReceivedSample> received = source.next();
    ASSERT_FALSE(received.ok());
    EXPECT_EQ(received.error().code, ErrorCode::kTimeout);
    EXPECT_LE(source.report().counters.frames, at_most);
  }
}

/// Frames that hold nothing, without end.
class FloodedLink final : public Link {
 public:
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    return received({0x31, 0x41, 0x59}, host_ms(0));
  }
  Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }
};

TEST(LinkSampleSource, ReadsAFloodOf100000PacketsASecondFasterThanItComes) {
  LinkInput input;
  input.clock = std::make_shared<ManualLinkClock>();
  input.link = std::make_unique<FloodedLink>();
  LinkSampleSource source(std::move(input));
  ASSERT_FALSE(source.next().ok());
  constexpr std::uint64_t kComesInMilliseconds = 100;  // the daemon's pause after each step is one
  EXPECT_GT(source.report().counters.frames, 2 * kComesInMilliseconds);
}

/// Shows the same time as the machine's monotonic clock.
class MonotonicLinkClock final : public LinkClock {
 public:
  HostTime now() override { return host_ms(0); }
  MonotonicTime monotonic_time_of(HostTime at) override { return MonotonicTime(at.time_since_epoch()); }
  void sleep_for(Duration /*duration*/) override {}
};

TEST(LinkSampleSource, ALiveSampleArrivesWithTheFrameThatCompletesIt) {
  SyntheticCapture capture;
  LinkInput input = input_of(capture.frames());
  input.clock = std::make_shared<MonotonicLinkClock>();
  LinkSampleSource source(std::move(input));
  Result<ReceivedSample> received = source.next();
  while (!received && received.error().code == ErrorCode::kTimeout) received = source.next();
  ASSERT_TRUE(received.ok());
  EXPECT_EQ(received->arrived_at.time_since_epoch(), capture.data(1).at.time_since_epoch());
}

TEST(LinkSampleSource, DoesNotAllocateForASample) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  SyntheticCapture capture;
  capture.packets = 1000;
  LinkSampleSource source(input_of(capture.frames()));
  ASSERT_TRUE(source.next().ok());
  const test::AllocationCounter counter;
  for (int i = 0; i < 900; ++i) ASSERT_TRUE(source.next().ok());
  EXPECT_EQ(counter.count(), 0U);
}

TEST(LinkSampleSource, FallsBackToADescriptionAndReportsIt) {
  SyntheticCapture capture;
  capture.with_toc = false;
  LinkInput input = input_of(capture.frames());
  BlockDescription description;
  description.source = "flight.pcap.toml";
  for (std::size_t i = 0; i < SyntheticCapture::kNames.size(); ++i)
    description.blocks[1].variables.push_back(
        {(i < 3 ? "stateEstimate." : "range.") + std::string(SyntheticCapture::kNames[i]),
         i < 3 ? LogType::kFloat : LogType::kUint16});
  input.description = description;
  LinkSampleSource source(std::move(input));
  EXPECT_TRUE(source.find_first_sample().ok());
  EXPECT_EQ(read_all(source).size(), 7U);
  EXPECT_THAT(source.report().notes, ElementsAre(HasSubstr("taken from flight.pcap.toml")));
}

TEST(LinkSampleSource, LearnsThePeriodOfABlockWhoseStartItHasNotSeen) {
  SyntheticCapture capture;
  std::vector<LinkFrame> frames = capture.handshake();
  frames.erase(frames.end() - 2, frames.end());
  for (int i = 0; i <= 40; i += 2)  // each 200 ms
    if (i != 20) frames.push_back(capture.data(i));
  LinkSampleSource source(input_of(frames));
  EXPECT_EQ(read_all(source).size(), 19U);  // without the first and the lost one
  EXPECT_EQ(source.report().counters.gaps, 1U);
  EXPECT_EQ(source.report().counters.missing_packets, 1U);
}

TEST(LinkSampleSource, MapsACaptureWithTheYawOfTheStabilizer) {
  SyntheticCapture capture;
  std::vector<LinkFrame> frames = capture.frames();
  const Bytes before = toc_item_reply(2, LogType::kFloat, "stateEstimate", "yaw");
  for (LinkFrame& frame : frames)
    if (std::ranges::equal(frame.packet(), before))
      frame = received(toc_item_reply(2, LogType::kFloat, "stabilizer", "yaw"), frame.at);
  LinkSampleSource source(input_of(frames));
  EXPECT_TRUE(source.find_first_sample().ok());
  EXPECT_EQ(read_all(source).size(), 7U);
}

TEST(LinkSampleSource, TellsOfDamageInTheDeadReckoning) {
  SyntheticCapture capture;
  capture.packets = 40;
  std::vector<LinkFrame> frames = capture.frames();
  LinkFrame damaged = capture.data(20);
  damaged.bytes[4] = 0x55;
  frames.insert(frames.end() - 30, damaged);
  LinkSampleSource source(input_of(frames));
  EXPECT_EQ(read_all(source).size(), 39U);
  source.end();
  EXPECT_EQ(source.report().counters.segments, 1U);
  EXPECT_THAT(source.report().problems, ElementsAre(HasSubstr("1 log packets have a time that")));
}

TEST(LinkSampleSource, TellsWhatLogPacketsLackedOnceAlsoWhereTheRunIsStopped) {
  SyntheticCapture capture;
  std::vector<LinkFrame> frames = capture.frames();
  const Bytes too_short = LogPacket(1, 1250).f32(0.F).bytes();
  frames.push_back(received(too_short, host_ms(1'700'000'002'000)));
  for (const ErrorCode at_the_end : {ErrorCode::kTimeout, ErrorCode::kEndOfRecording}) {
    LinkInput input = input_of(frames, {at_the_end, "nothing more"});
    input.clock = std::make_shared<ManualLinkClock>();
    LinkSampleSource source(std::move(input));
    for (int i = 0; i < 20; ++i) static_cast<void>(source.next());
    source.end();
    EXPECT_THAT(source.report().problems, ElementsAre(HasSubstr("1 log packets have another size")));
  }
}

TEST(LinkSampleSource, LeavesOutARunawayOfTheDeadReckoningAndTellsOfIt) {
  std::vector<LinkFrame> frames = SyntheticCapture{}.handshake();
  for (int i = 0; i < 4000; ++i) {
    const LogPacket packet = LogPacket(1, 1000 + 100 * static_cast<std::uint32_t>(i))
                                 .f32(0.4F * static_cast<float>(i))
                                 .f32(0.F)
                                 .f32(0.F)
                                 .u16(1000)
                                 .u16(1000)
                                 .u16(1000)
                                 .u16(1000);
    frames.push_back(received(packet.bytes(), host_ms(1'700'000'001'000 + 100L * i)));
  }
  LinkSampleSource source(input_of(frames));
  for (const RangeSample& sample : read_all(source)) ASSERT_LE(sample.T_odom_body.x_m(), 1000.0);
  source.end();
  EXPECT_EQ(source.report().counters.segments, 1U);
  EXPECT_THAT(source.report().problems, ElementsAre(HasSubstr("1498 range packets lie more than 1000 m")));
}

TEST(LinkSampleSource, ReportsWhyARecordingHoldsNoSample) {
  const auto reason = [](const std::vector<LinkFrame>& frames) {
    LinkSampleSource source(input_of(frames));
    const Status found = source.find_first_sample();
    return found ? "found one" : found.error().message;
  };
  SyntheticCapture capture;
  EXPECT_THAT(reason(capture.handshake()), HasSubstr("no range.front"));
  EXPECT_THAT(reason({capture.handshake().front()}), HasSubstr("flight.pcap: no range.front"));
  std::vector<LinkFrame> one = capture.handshake();
  one.push_back(capture.data(0));
  EXPECT_THAT(reason(one), HasSubstr("never lie close enough in time"));
  capture.with_toc = false;
  EXPECT_THAT(reason(capture.frames()), HasSubstr("describe them in flight.pcap.toml"));
}

TEST(LinkSampleSource, DeliversTheFirstSampleOnceAfterFindingIt) {
  LinkSampleSource source(input_of(SyntheticCapture{}.frames()));
  ASSERT_TRUE(source.find_first_sample().ok());
  const std::vector<RangeSample> samples = read_all(source);
  ASSERT_EQ(samples.size(), 7U);
  EXPECT_EQ(samples[0].sequence, 0U);
  EXPECT_EQ(samples[1].sequence, 1U);
}

TEST(LinkSampleSource, StartsTheLogOfALiveVehicle) {
  auto link = std::make_unique<ScriptedLink>();
  link->vehicle.variables = ScriptedVehicle::modern_variables();
  link->last_ms = 5000;
  LinkInput input;
  input.name = "sim://test";
  input.link = std::move(link);
  input.starts_logging = true;
  input.truth = KnownTruth{[](DeviceTime at) { return Pose2(to_seconds(at.time_since_epoch()), 0.0, 0.0); },
                           std::move(PoseFile::open()).value()};
  LinkSampleSource source(std::move(input));
  const std::vector<RangeSample> samples = read_all(source);
  ASSERT_GT(samples.size(), 40U);
  EXPECT_FLOAT_EQ(samples[0].distance_m[0], 1.0F);
  const std::vector<StampedPose> truth = source.ground_truth();
  ASSERT_EQ(truth.size(), samples.size());
  EXPECT_EQ(truth[9].stamp, samples[9].stamp);
  EXPECT_NEAR(truth[9].pose.x_m(), to_seconds(samples[9].measured_at.time_since_epoch()), 1e-12);
}

TEST(LinkSampleSource, NotesEachKindOfWarningOnceHoweverLongTheFlight) {
  auto link = std::make_unique<ScriptedLink>();
  link->vehicle.variables = ScriptedVehicle::modern_variables();
  link->reaches = [](std::int64_t ms) { return ms % 6000 < 3000; };
  LinkInput input;
  input.clock = std::make_shared<ScriptedClock>(*link);
  input.link = std::move(link);
  input.starts_logging = true;
  LinkSampleSource source(std::move(input));
  std::size_t stops = 0;
  for (Result<ReceivedSample> received = source.next();
       received || received.error().code == ErrorCode::kTimeout; received = source.next())
    while (const auto event = source.take_event())
      if (event->kind == VehicleEvent::Kind::kDataStopped) ++stops;
  EXPECT_GT(stops, 5U);
  source.end();
  EXPECT_THAT(source.report().notes, ElementsAre(HasSubstr("no log data for a second")));
}

/// A connection to a vehicle whose table of contents is unknown, in simulated time.
struct Connection {
  double seconds = 0.0;  ///< to its first sample
  std::vector<std::int32_t> progress_percent;
};

Connection connect(std::int64_t one_way_ms, double loss_share) {
  auto link = std::make_unique<DistantLink>();
  link->one_way_ms = one_way_ms;
  link->loss_share = loss_share;
  const DistantLink& watched = *link;
  LinkInput input;
  input.clock = std::make_shared<DistantClock>(*link);
  input.link = std::move(link);
  input.starts_logging = true;
  LinkSampleSource source(std::move(input));
  Connection connection;
  while (!source.next() && watched.now_ms < 600'000)
    while (const auto event = source.take_event())
      if (event->kind == VehicleEvent::Kind::kReadingTable)
        connection.progress_percent.push_back(event->value);
  connection.seconds = static_cast<double>(watched.now_ms) / 1000.0;
  return connection;
}

TEST(LinkSampleSource, ConnectsWithinTenSecondsIfAFifthIsLostEachWay) {
  EXPECT_LT(connect(1, 0.2).seconds, 10.0);
}

TEST(LinkSampleSource, ConnectsWithinHalfAMinuteOverALinkOf600MillisecondsThereAndBack) {
  EXPECT_LT(connect(300, 0.0).seconds, 30.0);
}

TEST(LinkSampleSource, ConnectsOverASlowAndLossyLink) { EXPECT_LT(connect(300, 0.2).seconds, 60.0); }

TEST(LinkSampleSource, TellsHowMuchOfTheTableOfContentsIsRead) {
  const std::vector<std::int32_t> progress_percent = connect(300, 0.0).progress_percent;
  ASSERT_GT(progress_percent.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(progress_percent));
  EXPECT_GT(progress_percent.back(), 80);
  EXPECT_TRUE(connect(1, 0.0).progress_percent.empty()) << "it takes a second";
}

/// Keeps the answers to requests for items of tables of contents, by port.
class TocRecording final : public FrameSink {
 public:
  void take(const LinkFrame& frame) noexcept override {
    if (frame.direction == LinkDirection::kToVehicle || !read_toc_item(frame.packet())) return;
    if (is_on(frame.packet(), kLogTocTopic)) ++log_items;
    if (is_on(frame.packet(), kParamTocTopic)) ++param_items;
  }
  std::size_t log_items = 0;
  std::size_t param_items = 0;
};

TEST(LinkSampleSource, RecordsBothTablesOfContentsAlsoIfTheyComeFromTheCache) {
  const TemporaryFile cache("cache");
  for (const bool is_cached : {false, true}) {
    TocRecording recording;
    auto link = std::make_unique<ScriptedLink>();
    link->vehicle.variables = ScriptedVehicle::modern_variables();
    const ScriptedLink& watched = *link;
    LinkInput input;
    input.clock = std::make_shared<ScriptedClock>(*link);
    input.link = std::move(link);
    input.starts_logging = true;
    input.cache_directory = cache.path();
    input.recording = &recording;
    LinkSampleSource source(std::move(input));
    while (watched.now_ms < 10'000) static_cast<void>(source.next());
    EXPECT_EQ(recording.log_items, ScriptedVehicle::modern_variables().size()) << is_cached;
    EXPECT_EQ(recording.param_items, watched.vehicle.params.size()) << is_cached;
  }
}

TEST(LinkSampleSource, ReportsWhyAVehicleCannotBeUsed) {
  auto link = std::make_unique<ScriptedLink>();
  link->vehicle.protocol = 2;
  LinkInput input;
  input.link = std::move(link);
  input.starts_logging = true;
  LinkSampleSource source(std::move(input));
  Result<ReceivedSample> received = source.next();
  while (received.error().code == ErrorCode::kTimeout) received = source.next();
  EXPECT_THAT(received.error().message, HasSubstr("CRTP protocol 2"));
}

}  // namespace
}  // namespace swiftlet
