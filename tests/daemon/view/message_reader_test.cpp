// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/message_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/sensing/range_sample.hpp"
#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

template <typename Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

pose_t pose_message(std::int8_t frame, std::int32_t sequence) {
  pose_t message{};
  message.utime = 1'000'000 + sequence;
  message.map_id = 5;
  message.sequence = sequence;
  message.frame = frame;
  message.x = 1.0 + frame;
  return message;
}

class MessageReaderTest : public testing::Test {
 protected:
  RunHistory history_;
  MessageReader reader_{history_};

  template <typename Message>
  void take(std::string_view channel, const Message& message) {
    reader_.take(channel, encoded(message), MonotonicTime());
  }
  std::vector<std::string> log() const {
    std::vector<std::string> texts;
    for (const RunEvent& event : history_.events_after(0)) texts.push_back(event.text);
    return texts;
  }
};

TEST_F(MessageReaderTest, JoinsTheFramesOfOnePose) {
  take("POSE", pose_message(pose_t::FRAME_MAP, 3));
  take("POSE_LOCAL", pose_message(pose_t::FRAME_LOCAL, 3));
  take("POSE_ODOM", pose_message(pose_t::FRAME_ODOM, 3));
  ASSERT_EQ(history_.poses_after(0).size(), 1U);
  EXPECT_EQ(history_.poses_after(0)[0].map[0], 1.0);
  EXPECT_EQ(history_.poses_after(0)[0].local[0], 2.0);
  EXPECT_EQ(history_.poses_after(0)[0].odom[0], 3.0);
}

ranges_t ranges_message(std::int32_t sequence) {
  ranges_t message{};
  message.map_id = 5;
  message.sequence = sequence;
  message.count = 3;
  message.bearing = {0.0F, 1.0F, 2.0F};
  message.distance = {1.5F, 0.0F, 0.0F};
  message.status = {ranges_t::STATUS_HIT, ranges_t::STATUS_NO_RETURN, ranges_t::STATUS_INVALID};
  return message;
}

TEST_F(MessageReaderTest, RangesBelongToThePoseOfTheirSequence) {
  take("POSE", pose_message(pose_t::FRAME_MAP, 3));
  take("POSE_LOCAL", pose_message(pose_t::FRAME_LOCAL, 3));
  take("POSE_ODOM", pose_message(pose_t::FRAME_ODOM, 3));
  take("RANGES", ranges_message(2));
  ASSERT_EQ(history_.poses_after(0).size(), 1U);
  EXPECT_THAT(history_.poses_after(0)[0].ranges_m, testing::IsEmpty());
  take("RANGES", ranges_message(3));
  EXPECT_THAT(history_.bearings_rad(), testing::ElementsAre(0.0F, 1.0F, 2.0F));
  EXPECT_THAT(history_.poses_after(0)[0].ranges_m, testing::ElementsAre(1.5F, 0.0F, -1.0F));
}

TEST_F(MessageReaderTest, RangesThatNoSensorHasAreRefused) {
  take("POSE", pose_message(pose_t::FRAME_MAP, 3));
  ranges_t unknown = ranges_message(3);
  unknown.distance[0] = std::nanf("");
  take("RANGES", unknown);
  ranges_t many = ranges_message(3);
  many.count = 65;
  many.bearing.resize(65);
  many.distance.resize(65);
  many.status.resize(65);
  take("RANGES", many);
  EXPECT_THAT(history_.bearings_rad(), testing::IsEmpty());
}

TEST_F(MessageReaderTest, WhatIsNoMessageOfOursChangesNothing) {
  std::vector<std::uint8_t> bytes = encoded(pose_message(pose_t::FRAME_MAP, 3));
  reader_.take("POSE", std::span(bytes).first(bytes.size() / 2), MonotonicTime());
  reader_.take("STATUS", bytes, MonotonicTime());
  reader_.take("ELSEWHERE", bytes, MonotonicTime());
  pose_t nowhere = pose_message(pose_t::FRAME_MAP, 3);
  nowhere.x = std::nan("");
  take("POSE", nowhere);
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, AStoreyThatNoBuildingHasIsRefused) {
  for (const int storey : {-1, static_cast<int>(kMaxStoreys)}) {
    pose_t pose = pose_message(pose_t::FRAME_MAP, 3);
    map_tile_t tile{};
    tile.version = 1;
    tile.resolution = 0.05;
    loop_closure_t closure{};
    pose.storey = tile.storey = closure.storey = static_cast<std::int8_t>(storey);
    landmarks_t walls{};
    walls.total = walls.count = 1;
    walls.landmarks.push_back({.id = 1, .storey = pose.storey, .start = {0, 0}, .end = {1, 0}});
    take("POSE", pose);
    take("MAP_TILE", tile);
    take("LANDMARKS", walls);
    take("LOOP_CLOSURE", closure);
  }
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, AClaimOfMoreWallsThanThereAreIsRefused) {
  landmarks_t walls{};
  walls.map_id = 5;
  std::vector<std::uint8_t> bytes = encoded(walls);
  bytes[bytes.size() - 4] = 0xff;  // their count, big-endian
  reader_.take("LANDMARKS", bytes, MonotonicTime());
  EXPECT_EQ(history_.generation(), 0U);
}

long peak_memory_kb() {
  rusage usage{};
  EXPECT_EQ(::getrusage(RUSAGE_SELF, &usage), 0);
  return usage.ru_maxrss;
}

TEST_F(MessageReaderTest, AClaimOfMoreBeamsThanThereAreCostsNoMemory) {
  std::vector<std::uint8_t> bytes = encoded(ranges_message(3));
  constexpr std::size_t kBeamBytes = 9;
  const std::size_t count_at = bytes.size() - 3 * kBeamBytes - 4;
  bytes[count_at] = 0x10;  // 268 million
  const auto before_kb = peak_memory_kb();
  reader_.take("RANGES", bytes, MonotonicTime());
  EXPECT_LT(peak_memory_kb() - before_kb, 100'000);
  EXPECT_EQ(history_.generation(), 0U);
}

status_t status_with_lists() {
  status_t status{};
  status.map_id = 5;
  for (const char* name : {"samples", "keyframes"}) {
    queue_status_t queue{};
    queue.name = name;
    status.queues.push_back(queue);
  }
  status.queue_count = 2;
  stage_time_t stage{};
  stage.name = "frame_to_pose";
  stage.count = 9;
  stage.p99 = 4.0;
  status.stages.push_back(stage);
  status.stage_count = 1;
  return status;
}

TEST_F(MessageReaderTest, TheLatencyIsThatOfTheStageToThePose) {
  take("STATUS", status_with_lists());
  EXPECT_EQ(value_of(history_.statuses().newest()).latency_p99_ms, 4.0);
}

TEST_F(MessageReaderTest, AClaimOfMoreQueuesOrStagesThanThereAreCostsNoMemory) {
  const std::vector<std::uint8_t> sound = encoded(status_with_lists());
  constexpr std::size_t kBehindStages = 8 + 1 + 8;
  const std::size_t stages_at = sound.size() - kBehindStages - (4 + 14 + 48) - 4;
  const std::size_t queues_at = stages_at - (4 + 10 + 16) - (4 + 8 + 16) - 4;
  const auto before_kb = peak_memory_kb();
  for (const std::size_t count_at : {queues_at, stages_at}) {
    std::vector<std::uint8_t> bytes = sound;
    ASSERT_EQ(bytes[count_at + 3], count_at == queues_at ? 2 : 1);
    bytes[count_at] = 0x01;  // 16 million
    reader_.take("STATUS", bytes, MonotonicTime());
  }
  EXPECT_LT(peak_memory_kb() - before_kb, 100'000);
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, ANameOfAQueueOrStageThatIsShorterThanNothingIsRefused) {
  for (const std::string_view name : {"samples", "frame_to_pose"}) {
    std::vector<std::uint8_t> bytes = encoded(status_with_lists());
    const auto found = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    ASSERT_NE(found, bytes.end());
    const std::array<std::uint8_t, 4> length{0x80, 0, 0, 0};  // big-endian
    std::copy(length.begin(), length.end(), found - 4);
    reader_.take("STATUS", bytes, MonotonicTime());
  }
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, WhatNoClockShowsIsRefused) {
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t utime_us : {kNever, std::int64_t{-1}, -kNever}) {
    pose_t pose = pose_message(pose_t::FRAME_MAP, 3);
    pose.utime = utime_us;
    take("POSE", pose);
  }
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, CountsThatNoRunReachesAreRefused) {
  status_t status{};
  status.map_id = 5;
  status.closures_dropped = std::numeric_limits<std::int64_t>::min();
  take("STATUS", status);
  status.closures_dropped = 0;
  status.missing_packets = -1;
  take("STATUS", status);
  status.missing_packets = 0;
  status.recorded_bytes = -1;
  take("STATUS", status);
  EXPECT_EQ(history_.generation(), 0U);
}

TEST_F(MessageReaderTest, WallsOfSeveralMessagesAreTakenTogether) {
  landmarks_t walls{};
  walls.map_id = 5;
  walls.total = 2;
  walls.count = 1;
  walls.landmarks.push_back({.id = 1, .storey = 0, .start = {0, 0}, .end = {1, 0}});
  take("LANDMARKS", walls);
  EXPECT_EQ(history_.walls().size(), 0U);
  walls.first = 1;
  take("LANDMARKS", walls);
  ASSERT_EQ(history_.walls().size(), 1U);
  EXPECT_EQ(value_of(history_.walls().newest()).size(), 2U);
}

TEST_F(MessageReaderTest, ChangesOfTheStateAreToldInWords) {
  status_t status{};
  status.map_id = 5;
  status.link.battery_v = 3.9;
  take("STATUS", status);
  status.link.condition = link_status_t::CONDITION_SILENT;
  status.link.battery_v = 3.1;
  take("STATUS", status);
  take("STATUS", status);
  status.state = status_t::STATE_FINISHED;
  take("STATUS", status);
  using testing::HasSubstr;
  EXPECT_THAT(log(), testing::ElementsAre(HasSubstr("does not answer"), HasSubstr("battery low"),
                                          HasSubstr("finished")));
}

TEST_F(MessageReaderTest, EventsAreToldAsTheyAre) {
  take("VEHICLE_EVENT", vehicle_event_t{.utime = 1, .map_id = 5, .text = "a range sensor hangs; land"});
  take("VEHICLE_EVENT", vehicle_event_t{.utime = 2, .map_id = 5, .text = "no text\n"});
  EXPECT_THAT(log(), testing::ElementsAre("a range sensor hangs; land"));
}

TEST_F(MessageReaderTest, OnePacketIsNoPackets) {
  status_t status{};
  status.map_id = 5;
  take("STATUS", status);
  status.missing_packets = 1;
  take("STATUS", status);
  status.utime = 60'000'000;
  status.missing_packets = 3;
  status.missed_deadlines = 1;
  take("STATUS", status);
  EXPECT_THAT(log(), testing::ElementsAre("1 packet with ranges missing, 1 in all",
                                          "2 packets with ranges missing, 3 in all",
                                          "1 pose later than allowed, 1 in all"));
}

TEST_F(MessageReaderTest, LossesEachSecondDoNotFillTheLog) {
  status_t status{};
  status.map_id = 5;
  status.missing_packets = 100;  // before anybody looked
  for (; status.utime <= 30'000'000; status.utime += 1'000'000) {
    take("STATUS", status);
    ++status.missing_packets;
  }
  EXPECT_THAT(log(), testing::ElementsAre("1 packet with ranges missing, 101 in all",
                                          "15 packets with ranges missing, 116 in all"));
}

TEST_F(MessageReaderTest, ALostVehicleIsTold) {
  pose_t pose = pose_message(pose_t::FRAME_MAP, 1);
  take("POSE", pose);
  pose.tracking = pose_t::TRACKING_LOST;
  take("POSE", pose);
  EXPECT_THAT(log(), testing::ElementsAre("first pose", testing::HasSubstr("lost")));
}

}  // namespace
}  // namespace swiftlet
