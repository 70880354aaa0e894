// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recorder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/capture/capture_reader.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/file_size_limit.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kFlight = "sim://office?seed=7";

std::vector<CaptureRecord> records_in(const fs::path& path) {
  std::vector<CaptureRecord> records;
  Result<CaptureReader> reader = CaptureReader::open(path.string());
  if (!reader) return records;
  Result<CaptureRecord> record = reader->next();
  for (; record; record = reader->next()) records.push_back(*record);
  EXPECT_EQ(record.error().code, ErrorCode::kEndOfRecording) << record.error().message;
  return records;
}

std::vector<RangeSample> samples_of(SampleSource& source, Recorder* recorder = nullptr) {
  std::vector<RangeSample> samples;
  for (Result<ReceivedSample> received = source.next();; received = source.next()) {
    if (recorder != nullptr) static_cast<void>(recorder->step());
    if (received) samples.push_back(received->sample);
    if (!received && received.error().code != ErrorCode::kTimeout) break;
  }
  return samples;
}

std::vector<RangeSample> replayed(const fs::path& path) {
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source(path.string(), {});
  return source ? samples_of(**source) : std::vector<RangeSample>();
}

bool same_motion(const RangeSample& a, const RangeSample& b) {
  return a.measured_at == b.measured_at && a.stamp == b.stamp && a.T_odom_body.x_m() == b.T_odom_body.x_m() &&
         a.T_odom_body.y_m() == b.T_odom_body.y_m() && a.T_odom_body.yaw_rad() == b.T_odom_body.yaw_rad();
}
bool same_measurement(const RangeSample& a, const RangeSample& b) {
  return same_motion(a, b) && a.beam_count == b.beam_count && a.distance_m == b.distance_m &&
         a.status == b.status;
}
bool same_sample(const RangeSample& a, const RangeSample& b) {
  return same_measurement(a, b) && a.sequence == b.sequence && a.starts_segment == b.starts_segment;
}

class RecorderTest : public testing::Test {
 protected:
  RecordingPlan into_file() const {
    RecordingPlan plan;
    plan.vehicle = radio_vehicle(0xE7);
    plan.file = (directory_.path() / "flight.pcap").string();
    plan.source_can_wait = false;
    return plan;
  }
  RecordingPlan into_directory(std::uint64_t max_file_bytes, std::uint64_t max_total_bytes) const {
    RecordingPlan plan = into_file();
    plan.file.clear();
    plan.directory = directory_.path() / "made" / "here";
    plan.began = HostTime(std::chrono::seconds(1'795'258'555));
    plan.max_file_bytes = max_file_bytes;
    plan.max_total_bytes = max_total_bytes;
    return plan;
  }
  std::unique_ptr<Recorder> open(RecordingPlan plan) {
    Result<std::unique_ptr<Recorder>> recorder = Recorder::open(
        std::move(plan), {.note = [this](const std::string& text) { notes_.push_back(text); },
                          .problem = [this](const std::string& text) { problems_.push_back(text); }});
    EXPECT_TRUE(recorder.ok()) << recorder.error().message;
    return recorder ? std::move(recorder).value() : nullptr;
  }
  /// Gives it the frames and ends the recording.
  static void record(Recorder& recorder, const std::vector<LinkFrame>& frames) {
    for (const LinkFrame& frame : frames) {
      recorder.sink().take(frame);
      static_cast<void>(recorder.step());
    }
    end(recorder);
  }
  static void end(Recorder& recorder) {
    recorder.sink().close();
    while (recorder.step() != StepResult::kFinished) {
    }
  }
  /// A whole simulated flight, received and recorded in lockstep; its samples as they came live.
  std::vector<RangeSample> record_flight(RecordingPlan plan) {
    const std::unique_ptr<Recorder> recorder = open(std::move(plan));
    SampleSourceOptions options;
    options.recording = &recorder->sink();
    const Result<std::unique_ptr<SampleSource>> source = open_sample_source(kFlight, options);
    std::vector<RangeSample> samples = samples_of(**source, recorder.get());
    end(*recorder);
    return samples;
  }
  /// The files of a recording in the directory, in their order.
  [[nodiscard]] std::vector<fs::path> parts() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(directory_.path() / "made" / "here"))
      files.push_back(entry.path());
    std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
      const auto key = [](const fs::path& path) { return std::pair(path.string().size(), path.string()); };
      return key(a) < key(b);
    });
    return files;
  }

  TemporaryDirectory directory_;
  std::vector<std::string> notes_;
  std::vector<std::string> problems_;
};

TEST_F(RecorderTest, AReplayGivesTheSamplesOfTheLiveRunFieldForField) {
  const std::vector<RangeSample> live = record_flight(into_file());
  const std::vector<RangeSample> again = replayed(directory_.path() / "flight.pcap");
  ASSERT_GT(live.size(), 1000U);
  ASSERT_EQ(again.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) ASSERT_TRUE(same_sample(again[i], live[i])) << i;
  EXPECT_THAT(problems_, IsEmpty());
  EXPECT_THAT(notes_, ElementsAre(AllOf(HasSubstr("recorded "), HasSubstr("flight.pcap"))));
}

TEST_F(RecorderTest, KeepsEveryPacketInOrderButTheNullPackets) {
  SyntheticCapture flight;
  const std::vector<LinkFrame> frames = flight.frames();  // with polls
  std::vector<LinkFrame> kept;
  std::ranges::copy_if(frames, std::back_inserter(kept),
                       [](const LinkFrame& frame) { return frame.bytes[0] != 0xFF; });
  ASSERT_LT(kept.size(), frames.size());
  const std::unique_ptr<Recorder> recorder = open(into_file());
  recorder->sink().take(received(hex("f7")));
  recorder->sink().take(received(hex("f3 01 2d")));
  record(*recorder, frames);
  const std::vector<CaptureRecord> records = records_in(directory_.path() / "flight.pcap");
  ASSERT_EQ(records.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(records[i].vehicle, radio_vehicle(0xE7));
    EXPECT_EQ(records[i].frame.at, kept[i].at);
    EXPECT_EQ(records[i].frame.direction, kept[i].direction);
    EXPECT_TRUE(std::ranges::equal(records[i].frame.packet(), kept[i].packet()));
  }
  EXPECT_EQ(recorder->bytes(), fs::file_size(directory_.path() / "flight.pcap"));
}

TEST_F(RecorderTest, WhatAStepHasTakenIsInTheFile) {
  const std::unique_ptr<Recorder> recorder = open(into_file());
  EXPECT_EQ(recorder->step(), StepResult::kIdle);
  recorder->sink().take(received(hex("52 01 8e 11 00")));
  EXPECT_EQ(recorder->step(), StepResult::kProgress);
  EXPECT_EQ(records_in(recorder->path()).size(), 1U);
}

TEST_F(RecorderTest, EveryPartReplaysOnItsOwnAndAllTogetherAreTheFlight) {
  const std::vector<RangeSample> live = record_flight(into_directory(80'000, 10'000'000));
  const std::vector<fs::path> files = parts();
  ASSERT_GT(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "swiftlet_20261121_105555.pcap");
  EXPECT_EQ(files[1].filename(), "swiftlet_20261121_105555_2.pcap");
  EXPECT_EQ(notes_.size(), files.size());

  std::size_t next = 0;  // of live
  std::size_t lost = 0;  // at the worst border
  for (const fs::path& file : files) {
    EXPECT_LT(fs::file_size(file), 81'000U);
    const std::vector<RangeSample> part = replayed(file);
    ASSERT_GE(part.size(), file == files.back() ? 2U : 100U);
    EXPECT_TRUE(part.front().starts_segment);
    // Lost at a border are exactly the samples measured before the first dead reckoning of the new file: that
    // stands in the packet which the first of them came in, a range's age later.
    const std::size_t border = next;
    while (next < live.size() && !same_motion(live[next], part.front())) ++next;
    if (next > border) {
      const DeviceTime first_odometry = live[border].measured_at + SensorModel::crazyflie().range_age;
      EXPECT_NE(file, files.front());
      EXPECT_LT(live[next - 1].measured_at, first_odometry);
      EXPECT_GE(part.front().measured_at, first_odometry);
    }
    lost = std::max(lost, next - border);
    // The tilt that the first two are levelled by may be in the file before, that of the last in the next.
    for (std::size_t i = 0; i < part.size(); ++i, ++next) {
      const bool has_its_tilt = i >= 2 && i + 1 < part.size();
      ASSERT_TRUE(has_its_tilt ? same_measurement(part[i], live.at(next))
                               : same_motion(part[i], live.at(next)));
    }
  }
  EXPECT_EQ(next, live.size());
  EXPECT_GE(lost, 1U);
  EXPECT_LE(lost, 2U);
}

TEST_F(RecorderTest, ThePartsBehindOneAnotherAreTheWholeFlight) {
  const std::vector<RangeSample> live = record_flight(into_directory(80'000, 10'000'000));
  const fs::path whole = directory_.path() / "whole.pcap";
  Result<CaptureWriter> writer = CaptureWriter::create(whole.string(), radio_vehicle(0xE7));
  for (const fs::path& file : parts())
    for (const CaptureRecord& record : records_in(file)) ASSERT_TRUE(writer->write(record.frame).ok());
  ASSERT_TRUE(writer->close().ok());
  const std::vector<RangeSample> again = replayed(whole);
  ASSERT_EQ(again.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) ASSERT_TRUE(same_sample(again[i], live[i])) << i;
}

TEST_F(RecorderTest, DoesNotChangeTheFileBetweenARequestAndItsReply) {
  const std::unique_ptr<Recorder> recorder = open(into_directory(1, 10'000'000));  // at the first chance
  const SyntheticCapture flight;
  std::vector<LinkFrame> frames = flight.handshake();
  const LinkFrame reply = frames.back();
  frames.pop_back();
  frames.push_back(flight.data(0));  // a block that runs already; the request is still unanswered
  frames.push_back(reply);
  frames.push_back(flight.data(1));
  record(*recorder, frames);
  const std::vector<fs::path> files = parts();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(records_in(files[0]).size(), frames.size() - 1);
  EXPECT_EQ(records_in(files[1]).back().frame.at, flight.data(1).at);
}

TEST_F(RecorderTest, RemovesTheOldestFilesBeyondTheTotal) {
  record_flight(into_directory(80'000, 170'000));
  const std::vector<fs::path> files = parts();
  ASSERT_LE(files.size(), 3U);
  EXPECT_NE(files[0].filename(), "swiftlet_20261121_105555.pcap");
  std::uintmax_t total = 0;
  for (const fs::path& file : files) total += fs::file_size(file);
  EXPECT_LE(total, 171'000U);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("removed the oldest recording")));
}

TEST_F(RecorderTest, TwoThatBeganInTheSameSecondHaveTheirOwnFiles) {
  const std::unique_ptr<Recorder> one = open(into_directory(80'000, 10'000'000));
  const std::unique_ptr<Recorder> other = open(into_directory(80'000, 10'000'000));
  EXPECT_NE(one->path(), other->path());
}

TEST_F(RecorderTest, DoesNotOverwriteAFile) {
  std::ofstream(into_file().file) << "mine";
  const Result<std::unique_ptr<Recorder>> recorder = Recorder::open(into_file(), {});
  ASSERT_FALSE(recorder.ok());
  EXPECT_THAT(recorder.error().message, HasSubstr("flight.pcap: is there already"));
  EXPECT_EQ(text_of(into_file().file), "mine");
}

TEST_F(RecorderTest, SaysWhereItCannotMakeTheDirectory) {
  std::ofstream(directory_.path() / "made") << "in the way";
  const Result<std::unique_ptr<Recorder>> recorder = Recorder::open(into_directory(80'000, 170'000), {});
  ASSERT_FALSE(recorder.ok());
  EXPECT_THAT(recorder.error().message, AllOf(HasSubstr("made/here"), HasSubstr("cannot be made")));
}

TEST_F(RecorderTest, KeepsNoFileOfAVehicleThatWasNeverHeard) {
  {
    const std::unique_ptr<Recorder> recorder = open(into_file());
    record(*recorder, {sent(hex("fd 00"))});
    EXPECT_FALSE(fs::exists(into_file().file));
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("never received")));
  }
  open(into_file()).reset();  // never stepped
  EXPECT_FALSE(fs::exists(into_file().file));
}

TEST_F(RecorderTest, AFullDiskEndsTheRecordingWithOneMessageAndNothingElse) {
  std::vector<RangeSample> live;
  bool failed = false;
  {
    const FileSizeLimit limit(200'000);
    const std::unique_ptr<Recorder> recorder = open(into_file());
    SampleSourceOptions options;
    options.recording = &recorder->sink();
    const Result<std::unique_ptr<SampleSource>> source = open_sample_source(kFlight, options);
    live = samples_of(**source, recorder.get());
    end(*recorder);
    failed = recorder->failed();
  }
  EXPECT_TRUE(failed);
  ASSERT_EQ(problems_.size(), 1U);
  EXPECT_THAT(problems_[0], AllOf(HasSubstr("recording stopped"), HasSubstr("flight.pcap"),
                                  HasSubstr("cannot be written any further"), HasSubstr("make room")));
  EXPECT_THAT(notes_, IsEmpty());
  const std::vector<RangeSample> kept = replayed(into_file().file);  // and is not damaged at its end
  ASSERT_GT(kept.size(), 1000U);
  ASSERT_GT(live.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) ASSERT_TRUE(same_sample(kept[i], live[i])) << i;
  EXPECT_FALSE(records_in(into_file().file).empty());
}

TEST_F(RecorderTest, SaysOnceThatItsQueueWasFullAndCountsWhatWasLeftOut) {
  const std::unique_ptr<Recorder> recorder = open(into_file());
  const LinkFrame frame = received(hex("52 01 8e 11 00"));
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < RecordingQueue::capacity() + 3; ++i) recorder->sink().take(frame);
    while (recorder->step() == StepResult::kProgress) {
    }
  }
  end(*recorder);
  EXPECT_THAT(problems_, ElementsAre(HasSubstr("has a hole")));
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("6 left out")));
  EXPECT_EQ(records_in(into_file().file).size(), 2 * RecordingQueue::capacity());
}

TEST_F(RecorderTest, ASourceThatCanWaitLosesNothing) {
  RecordingPlan plan = into_file();
  plan.source_can_wait = true;
  const std::unique_ptr<Recorder> recorder = open(std::move(plan));
  constexpr std::size_t kFrames = 5 * RecordingQueue::capacity();
  {
    const RecorderThread thread(*recorder);
    for (std::size_t i = 0; i < kFrames; ++i)
      recorder->sink().take(received(hex("52 01 8e 11 00"), host_ms(static_cast<std::int64_t>(i))));
  }
  EXPECT_THAT(problems_, IsEmpty());
  EXPECT_EQ(records_in(into_file().file).size(), kFrames);
}

}  // namespace
}  // namespace swiftlet
