// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/link.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "tests/firmware_link/simulated_log_id.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// x and y of the estimate as floats and the left range, every 100 ms.
void start_logging(SimulatedLink& link) {
  const Bytes create{0x5D,
                     0x06,
                     0x01,
                     0x07,
                     low_byte(simulated_log_id("stateEstimate", "x")),
                     0x00,
                     0x07,
                     low_byte(simulated_log_id("stateEstimate", "y")),
                     0x00,
                     0x02,
                     low_byte(simulated_log_id("range", "left")),
                     0x00};
  ASSERT_TRUE(link.send(create).ok());
  ASSERT_TRUE(link.send(Bytes{0x5D, 0x03, 0x01, 0x0A}).ok());
}

std::vector<LinkFrame> frames_of(SimulatedLink& link) {
  start_logging(link);
  std::vector<LinkFrame> frames;
  while (true) {
    const Result<LinkFrame> frame = link.receive(std::chrono::seconds(1));
    if (!frame.ok()) {
      EXPECT_EQ(frame.error().code, ErrorCode::kEndOfRecording);
      return frames;
    }
    frames.push_back(*frame);
  }
}

std::vector<LinkFrame> frames_of(std::string_view world, std::uint64_t seed) {
  const Result<std::unique_ptr<SimulatedLink>> link = SimulatedLink::open(world, seed);
  EXPECT_TRUE(link.ok());
  return frames_of(**link);
}

bool is_log_data(const LinkFrame& frame) { return (frame.bytes[0] & 0xF3U) == 0x52U; }
std::uint32_t stamp_of(const LinkFrame& frame) {
  return frame.bytes[2] | static_cast<std::uint32_t>(frame.bytes[3]) << 8U |
         static_cast<std::uint32_t>(frame.bytes[4]) << 16U;
}
double float_at(const LinkFrame& frame, std::size_t offset) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>(frame.bytes[offset + i]) << (8U * i);
  return static_cast<double>(std::bit_cast<float>(bits));
}

/// Log packets by their stamp.
std::map<std::uint32_t, Bytes> packets_of(const std::vector<LinkFrame>& frames) {
  std::map<std::uint32_t, Bytes> packets;
  for (const LinkFrame& frame : frames)
    if (is_log_data(frame)) packets[stamp_of(frame)] = Bytes(frame.packet().begin(), frame.packet().end());
  return packets;
}

bool same(const std::vector<LinkFrame>& a, const std::vector<LinkFrame>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LinkFrame& f, const LinkFrame& g) {
    return f.at == g.at && f.direction == g.direction && f.size == g.size && f.bytes == g.bytes;
  });
}

TEST(SimulatedLink, DeliversTheRequestAndThenTheAnswer) {
  const Result<std::unique_ptr<SimulatedLink>> opened = SimulatedLink::open("office", 1);
  ASSERT_TRUE(opened.ok());
  SimulatedLink& link = **opened;
  ASSERT_TRUE(link.send(Bytes{0xDD, 0x00}).ok());
  const Result<LinkFrame> request = link.receive(Duration(0));
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(request->direction, LinkDirection::kToVehicle);
  EXPECT_EQ(request->size, 2);
  const Result<LinkFrame> answer = link.receive(Duration(0));
  ASSERT_TRUE(answer.ok());
  EXPECT_EQ(answer->direction, LinkDirection::kFromVehicle);
  EXPECT_EQ(answer->bytes[2], 12);
}

TEST(SimulatedLink, AdvancesSimulatedTimeInATimeout) {
  const Result<std::unique_ptr<SimulatedLink>> opened = SimulatedLink::open("office", 1);
  ASSERT_TRUE(opened.ok());
  SimulatedLink& link = **opened;
  ASSERT_TRUE(link.send(Bytes{0xFC}).ok());
  const HostTime before = link.receive(Duration(0)).value().at;
  ASSERT_TRUE(link.receive(Duration(0)).ok());
  const Result<LinkFrame> nothing = link.receive(std::chrono::milliseconds(250));
  ASSERT_FALSE(nothing.ok());
  EXPECT_EQ(nothing.error().code, ErrorCode::kTimeout);
  ASSERT_TRUE(link.send(Bytes{0xFC}).ok());
  EXPECT_EQ(link.receive(Duration(0)).value().at - before, std::chrono::milliseconds(250));
}

TEST(SimulatedLink, RefusesAnInvalidPacket) {
  const Result<std::unique_ptr<SimulatedLink>> opened = SimulatedLink::open("office", 1);
  ASSERT_TRUE(opened.ok());
  EXPECT_FALSE((*opened)->send(Bytes{}).ok());
  EXPECT_FALSE((*opened)->send(Bytes(32, 0xFF)).ok());
}

TEST(SimulatedLink, DeliversTheWholeFlightAndThenEnds) {
  const Result<std::unique_ptr<SimulatedLink>> opened = SimulatedLink::open("office", 1);
  ASSERT_TRUE(opened.ok());
  const std::vector<LinkFrame> frames = frames_of(**opened);
  EXPECT_EQ((*opened)->progress(), 1.0);
  EXPECT_GT(frames.size(), 3300U);
  EXPECT_LT(frames.size(), 5000U);
}

TEST(SimulatedLink, FliesTheRequestedNumberOfLaps) {
  const auto two = SimulatedLink::open("loop", 1, 2);
  ASSERT_TRUE(two.ok());
  const std::size_t frames_of_one = frames_of("loop", 1).size();
  EXPECT_GT(frames_of(**two).size(), 3 * frames_of_one / 2);
}

TEST(SimulatedLink, HasBatteryForTheWaysBackOfAnOpenScript) {
  const auto maze = SimulatedLink::open("maze", 2, 3);
  ASSERT_TRUE(maze.ok());
  start_logging(**maze);
  Result<LinkFrame> frame = (*maze)->receive(std::chrono::seconds(1));
  while (frame) frame = (*maze)->receive(std::chrono::seconds(1));
  EXPECT_EQ(frame.error().code, ErrorCode::kEndOfRecording) << "landed, not dropped";
}

TEST(SimulatedLink, RepeatsItselfByteForByteForTheSameSeed) {
  for (const char* world : {"office", "maze", "loop", "corridors", "building"})
    EXPECT_TRUE(same(frames_of(world, 5), frames_of(world, 5))) << world;
}

TEST(SimulatedLink, DiffersForAnotherSeed) {
  EXPECT_FALSE(same(frames_of("office", 5), frames_of("office", 6)));
  EXPECT_FALSE(same(frames_of("building", 5), frames_of("building", 6)));
}

TEST(SimulatedLink, LosesAboutOnePacketInAHundred) {
  const std::map<std::uint32_t, Bytes> packets = packets_of(frames_of("loop", 2));
  int lost = 0;
  std::uint32_t before = 0;
  for (const auto& [stamp, packet] : packets) {
    if (before != 0) lost += static_cast<int>(std::lround((stamp - before) / 100.0)) - 1;
    before = stamp;
  }
  EXPECT_NEAR(lost / static_cast<double>(packets.size()), SimulatedLink::kPacketLoss, 0.006);
}

TEST(SimulatedLink, KeepsAllOtherNoiseWhenTheLossChanges) {
  SimulatedLink lossless(make_simulated_world("maze").value(), {}, 0.0, 3);
  SimulatedLink lossy(make_simulated_world("maze").value(), {}, 0.2, 3);
  const std::map<std::uint32_t, Bytes> all = packets_of(frames_of(lossless));
  const std::map<std::uint32_t, Bytes> some = packets_of(frames_of(lossy));
  EXPECT_NEAR(static_cast<double>(some.size()), 0.8 * static_cast<double>(all.size()),
              0.03 * static_cast<double>(all.size()));
  for (const auto& [stamp, packet] : some) {
    ASSERT_TRUE(all.contains(stamp));
    EXPECT_EQ(all.at(stamp), packet);
  }
}

TEST(SimulatedLink, KnowsTheTruthThatTheEstimateDriftsAwayFrom) {
  const Result<std::unique_ptr<SimulatedLink>> opened = SimulatedLink::open("office", 1);
  ASSERT_TRUE(opened.ok());
  SimulatedLink& link = **opened;
  start_logging(link);
  const Pose2 T_world_start = link.T_world_body(DeviceTime{});
  double early_m = 0.0;
  double worst_m = 0.0;
  int packets = 0;
  for (auto frame = link.receive(std::chrono::seconds(1)); frame;
       frame = link.receive(std::chrono::seconds(1))) {
    if (!is_log_data(*frame)) continue;
    const DeviceTime at(std::chrono::milliseconds(stamp_of(*frame)));
    const Pose2 truth = between(T_world_start, link.T_world_body(at));
    const double error_m = std::hypot(float_at(*frame, 5) - truth.x_m(), float_at(*frame, 9) - truth.y_m());
    worst_m = std::max(worst_m, error_m);
    if (++packets == 60) early_m = error_m;
  }
  EXPECT_LT(early_m, 0.1);
  EXPECT_GT(worst_m, 0.5);
  EXPECT_LT(worst_m, 5.0);
}

TEST(SimulatedLink, ListsTheWorldsForAnUnknownOne) {
  const Result<std::unique_ptr<SimulatedLink>> link = SimulatedLink::open("cave", 1);
  ASSERT_FALSE(link.ok());
  EXPECT_EQ(link.error().message,
            "no simulated world is called \"cave\"; choose one of: " + simulated_world_names());
}

}  // namespace
}  // namespace swiftlet
