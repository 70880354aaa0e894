// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/reading_extractor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;

class ReadingExtractorTest : public testing::Test {
 protected:
  using Variables = std::vector<BlockDescription::Variable>;

  void describe(std::uint8_t block, const Variables& variables) {
    description_.blocks[block].variables = variables;
    description_.blocks[block].period = std::chrono::milliseconds(10 * block);
  }
  std::optional<Reading> extract(const LogPacket& packet, HostTime at = host_ms(5)) {
    if (!described_) session_.describe(description_);
    described_ = true;
    frame_ = received(packet.bytes(), at);
    const std::optional<LogRecord> record = session_.on_frame(frame_);
    return record ? extractor_.extract(*record) : std::nullopt;
  }

  BlockDescription description_;
  bool described_ = false;
  LogSession session_;
  ReadingExtractor extractor_{session_};
  LinkFrame frame_;
};

TEST_F(ReadingExtractorTest, ExtractsPositionYawAndRangesOfOneBlock) {
  describe(1, {{"stateEstimate.x", LogType::kFloat},
               {"stateEstimate.y", LogType::kFloat},
               {"stateEstimate.yaw", LogType::kFloat},
               {"range.front", LogType::kUint16},
               {"range.back", LogType::kUint16},
               {"range.left", LogType::kUint16},
               {"range.right", LogType::kUint16}});
  const auto reading =
      extract(LogPacket(1, 1234).f32(1.5F).f32(-2.F).f32(90.F).u16(1000).u16(2000).u16(3000).u16(4000));
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->at, device_ms(1234));
  EXPECT_EQ(reading->received, host_ms(5));
  EXPECT_DOUBLE_EQ(reading->position_odom->x_m, 1.5);
  EXPECT_DOUBLE_EQ(reading->position_odom->y_m, -2.0);
  EXPECT_NEAR(*reading->yaw_odom_rad, kPi / 2.0, 1e-12);
  EXPECT_THAT(reading->distance_m, ElementsAre(1.F, 3.F, 2.F, 4.F));  // front, left, back, right
  EXPECT_EQ(extractor_.range_period(), std::chrono::milliseconds(10));
  EXPECT_TRUE(extractor_.missing_ranges().empty());
}

TEST_F(ReadingExtractorTest, ExtractsThemFromDifferentBlocks) {
  describe(1, {{"stateEstimateZ.x", LogType::kInt16}, {"stateEstimateZ.y", LogType::kInt16}});
  describe(2, {{"stateEstimate.qw", LogType::kFloat},
               {"stateEstimate.qx", LogType::kFloat},
               {"stateEstimate.qy", LogType::kFloat},
               {"stateEstimate.qz", LogType::kFloat},
               {"range.front", LogType::kUint16}});
  const auto position = extract(LogPacket(1, 10).i16(1500).i16(-250));
  ASSERT_TRUE(position.has_value());
  EXPECT_NEAR(position->position_odom->x_m, 1.5, 1e-12);
  EXPECT_NEAR(position->position_odom->y_m, -0.25, 1e-12);
  EXPECT_FALSE(position->yaw_odom_rad.has_value());
  EXPECT_TRUE(position->distance_m.empty());
  const auto s = static_cast<float>(std::sqrt(0.5));
  const auto attitude = extract(LogPacket(2, 14).f32(s).f32(0.F).f32(0.F).f32(s).u16(700));
  ASSERT_TRUE(attitude.has_value());
  EXPECT_FALSE(attitude->position_odom.has_value());
  EXPECT_NEAR(*attitude->yaw_odom_rad, kPi / 2.0, 1e-6);
  ASSERT_EQ(attitude->distance_m.size(), 4U);
  EXPECT_FLOAT_EQ(attitude->distance_m[0], 0.7F);
  EXPECT_TRUE(std::isnan(attitude->distance_m[1]));
  EXPECT_THAT(extractor_.missing_ranges(), ElementsAre("range.left", "range.back", "range.right"));
  EXPECT_EQ(extractor_.range_period(), std::chrono::milliseconds(20));
  EXPECT_EQ(extractor_.odometry_period(), std::chrono::milliseconds(20));
}

TEST_F(ReadingExtractorTest, KnowsTheOtherNamesOfPositionAndYaw) {
  describe(1, {{"kalman.stateX", LogType::kFloat}, {"kalman.stateY", LogType::kFloat}});
  describe(2, {{"stateEstimateZ.quat", LogType::kUint32}});
  EXPECT_DOUBLE_EQ(extract(LogPacket(1, 10).f32(0.5F).f32(0.25F))->position_odom->x_m, 0.5);
  EXPECT_DOUBLE_EQ(*extract(LogPacket(2, 10).u32(0xC0000000U))->yaw_odom_rad, 0.0);
}

TEST_F(ReadingExtractorTest, ExtractsTiltHeightAndAltitudeWhereTheyAreLogged) {
  describe(1, {{"stateEstimate.x", LogType::kFloat},
               {"stateEstimate.y", LogType::kFloat},
               {"stateEstimate.yaw", LogType::kFloat},
               {"range.zrange", LogType::kUint16}});
  describe(2, {{"stateEstimate.roll", LogType::kFloat},
               {"stateEstimate.pitch", LogType::kFloat},
               {"baro.asl", LogType::kFloat}});
  const auto pose = extract(LogPacket(1, 10).f32(0.F).f32(0.F).f32(0.F).u16(512));
  ASSERT_TRUE(pose.has_value());
  EXPECT_DOUBLE_EQ(pose->height_m.value_or(0.0), 0.512);
  EXPECT_FALSE(pose->tilt.has_value());
  EXPECT_TRUE(std::isnan(*extract(LogPacket(1, 20).f32(0.F).f32(0.F).f32(0.F).u16(8190))->height_m));
  const auto attitude = extract(LogPacket(2, 14).f32(-30.F).f32(10.F).f32(431.5F));
  ASSERT_TRUE(attitude.has_value());
  EXPECT_NEAR(attitude->tilt->x_up, std::sin(radians(10.0)), 1e-9) << "nose up";
  EXPECT_LT(attitude->tilt->y_up, 0.0) << "left side down";
  EXPECT_EQ(attitude->altitude_m, 431.5);
  EXPECT_FALSE(attitude->yaw_odom_rad.has_value());
}

TEST_F(ReadingExtractorTest, AQuaternionHoldsTheTiltToo) {
  describe(1, {{"stateEstimateZ.z", LogType::kInt16}});
  describe(2, {{"stateEstimateZ.quat", LogType::kUint32}});
  EXPECT_NEAR(*extract(LogPacket(1, 10).i16(700))->height_m, 0.7, 1e-12);
  const auto attitude = extract(LogPacket(2, 10).u32(0xC0000000U));
  EXPECT_DOUBLE_EQ(attitude->tilt->x_up, 0.0);
  EXPECT_DOUBLE_EQ(attitude->tilt->y_up, 0.0);
}

TEST_F(ReadingExtractorTest, MotorsThatAreOffDoNotFly) {
  describe(1, {{"stateEstimate.yaw", LogType::kFloat}, {"stabilizer.thrust", LogType::kFloat}});
  EXPECT_TRUE(*extract(LogPacket(1, 10).f32(0.F).f32(38000.F))->is_flying);
  EXPECT_FALSE(*extract(LogPacket(1, 20).f32(0.F).f32(0.F))->is_flying);
}

/// The blocks of the vendor's example multiranger_pointcloud.py.
TEST_F(ReadingExtractorTest, ExtractsTheYawOfTheStabilizer) {
  describe(1, {{"stateEstimate.x", LogType::kFloat},
               {"stateEstimate.y", LogType::kFloat},
               {"stateEstimate.z", LogType::kFloat}});
  describe(2, {{"range.front", LogType::kUint16},
               {"range.back", LogType::kUint16},
               {"range.up", LogType::kUint16},
               {"range.left", LogType::kUint16},
               {"range.right", LogType::kUint16},
               {"range.zrange", LogType::kUint16},
               {"stabilizer.roll", LogType::kFloat},
               {"stabilizer.pitch", LogType::kFloat},
               {"stabilizer.yaw", LogType::kFloat}});
  EXPECT_TRUE(extract(LogPacket(1, 10).f32(1.F).f32(2.F).f32(0.5F))->position_odom.has_value());
  const auto reading = extract(
      LogPacket(2, 12).u16(1000).u16(2000).u16(5).u16(3000).u16(4000).u16(500).f32(1.F).f32(2.F).f32(-90.F));
  ASSERT_TRUE(reading.has_value());
  ASSERT_TRUE(reading->yaw_odom_rad.has_value());
  EXPECT_NEAR(*reading->yaw_odom_rad, -kPi / 2.0, 1e-12);
  EXPECT_THAT(reading->distance_m, ElementsAre(1.F, 3.F, 2.F, 4.F));
}

TEST_F(ReadingExtractorTest, ExtractsWhetherTheVehicleFlies) {
  describe(1, {{"stateEstimate.yaw", LogType::kFloat}, {"supervisor.info", LogType::kUint16}});
  EXPECT_EQ(extract(LogPacket(1, 10).f32(0.F).u16(0x0018))->is_flying, true);
  EXPECT_EQ(extract(LogPacket(1, 20).f32(0.F).u16(0x000F))->is_flying, false);
}

TEST_F(ReadingExtractorTest, ExtractsWhetherTheVehicleFliesFromOlderFirmware) {
  describe(1, {{"stateEstimate.yaw", LogType::kFloat}, {"sys.isFlying", LogType::kUint8}});
  EXPECT_EQ(extract(LogPacket(1, 10).f32(0.F).u8(1))->is_flying, true);
  EXPECT_EQ(extract(LogPacket(1, 20).f32(0.F).u8(0))->is_flying, false);
}

TEST_F(ReadingExtractorTest, APackedQuaternionInATypeThatCannotHoldItIsNoYaw) {
  describe(1, {{"stateEstimateZ.quat", LogType::kInt32}});
  const std::optional<Reading> reading = extract(LogPacket(1, 10).u32(0xC0000000U));
  ASSERT_TRUE(reading.has_value());
  EXPECT_TRUE(std::isnan(*reading->yaw_odom_rad));
}

TEST_F(ReadingExtractorTest, KeepsToTheFirstBlockThatOffersAPosition) {
  describe(1, {{"stateEstimate.x", LogType::kFloat}, {"stateEstimate.y", LogType::kFloat}});
  describe(2, {{"stateEstimateZ.x", LogType::kInt16}, {"stateEstimateZ.y", LogType::kInt16}});
  EXPECT_TRUE(extract(LogPacket(1, 10).f32(0.5F).f32(0.F)).has_value());
  EXPECT_FALSE(extract(LogPacket(2, 12).i16(500).i16(0)).has_value());
  EXPECT_TRUE(extract(LogPacket(1, 20).f32(0.5F).f32(0.F)).has_value());
}

TEST_F(ReadingExtractorTest, ABetterBlockOfADescriptionTakesOverWhenItComes) {
  describe(1, {{"range.front", LogType::kUint16}});
  describe(2, {{"range.front", LogType::kUint16}, {"range.back", LogType::kUint16}});
  EXPECT_TRUE(extract(LogPacket(1, 10).u16(500)).has_value());
  EXPECT_TRUE(extract(LogPacket(2, 20).u16(500).u16(500)).has_value());
  EXPECT_FALSE(extract(LogPacket(1, 30).u16(500)).has_value());
}

TEST_F(ReadingExtractorTest, AHeightThatStaysZeroIsMeasuredByNothing) {
  describe(1, {{"range.zrange", LogType::kUint16}});
  EXPECT_EQ(extract(LogPacket(1, 10).u16(0), host_ms(1000))->height_m, 0.0);
  EXPECT_EQ(extract(LogPacket(1, 20).u16(0), host_ms(3000))->height_m, 0.0);
  EXPECT_TRUE(std::isnan(*extract(LogPacket(1, 30).u16(0), host_ms(3100))->height_m));
  EXPECT_DOUBLE_EQ(*extract(LogPacket(1, 40).u16(250), host_ms(3200))->height_m, 0.25);
  EXPECT_EQ(extract(LogPacket(1, 50).u16(0), host_ms(9000))->height_m, 0.0);  // it has landed
}

TEST_F(ReadingExtractorTest, AHeightALittleBelowZeroIsThatOfAVehicleOnTheFloor) {
  describe(1, {{"stateEstimateZ.z", LogType::kInt16}});
  EXPECT_DOUBLE_EQ(*extract(LogPacket(1, 10).i16(-3), host_ms(1000))->height_m, -0.003);
  EXPECT_DOUBLE_EQ(*extract(LogPacket(1, 20).i16(0), host_ms(9000))->height_m, 0.0);
}

/// Blocks that hold the same variables.
class RunningBlocksTest : public ReadingExtractorTest {
 protected:
  void learn(const LinkFrame& frame) { static_cast<void>(session_.on_frame(frame)); }
  /// A period of 0: it is not started.
  void make(std::uint8_t block, const Bytes& variables, std::uint8_t period_10ms = 10) {
    Bytes create{0x5D, 6, block};
    create.insert(create.end(), variables.begin(), variables.end());
    learn(sent(create));
    learn(received({0x5D, 6, block, 0}));
    if (period_10ms == 0) return;
    learn(sent({0x5D, 3, block, period_10ms}));
    learn(received({0x5D, 3, block, 0}));
  }
};

TEST_F(RunningBlocksTest, ThePositionIsTakenFromTheLowestThatRunsWhoeverIsFirst) {
  learn(received(toc_item_reply(0, LogType::kFloat, "stateEstimate", "x")));
  learn(received(toc_item_reply(1, LogType::kFloat, "stateEstimate", "y")));
  const Bytes position{7, 0, 0, 7, 1, 0};
  make(1, position, 0);
  make(2, position);
  make(16, position);
  EXPECT_FALSE(extract(LogPacket(16, 100).f32(5.F).f32(5.F)));
  EXPECT_TRUE(extract(LogPacket(2, 110).f32(1.F).f32(1.F)));
  EXPECT_FALSE(extract(LogPacket(16, 120).f32(5.F).f32(5.F)));
  learn(sent({0x5D, 2, 2}));
  learn(received({0x5D, 2, 2, 0}));
  EXPECT_TRUE(extract(LogPacket(16, 130).f32(5.F).f32(5.F)));
}

TEST_F(RunningBlocksTest, OneThatFallsSilentIsReplaced) {
  learn(received(toc_item_reply(0, LogType::kFloat, "stateEstimate", "x")));
  learn(received(toc_item_reply(1, LogType::kFloat, "stateEstimate", "y")));
  const Bytes position{7, 0, 0, 7, 1, 0};
  make(2, position);
  make(16, position);
  const auto takes = [&](std::uint8_t block, int at_ms) {
    return extract(LogPacket(block, static_cast<std::uint32_t>(at_ms)).f32(1.F).f32(1.F), host_ms(at_ms))
        .has_value();
  };
  EXPECT_TRUE(takes(2, 1000));
  EXPECT_FALSE(takes(16, 60'000));  // after a pause of all
  for (int at_ms = 60'100; at_ms <= 62'000; at_ms += 100) EXPECT_FALSE(takes(16, at_ms));
  EXPECT_TRUE(takes(16, 62'100));
  EXPECT_FALSE(takes(2, 62'200));
}

TEST_F(RunningBlocksTest, OneThatFallsSilentIsReplacedByTheBestThatIsHeard) {
  for (std::uint16_t i = 0; i < 4; ++i)
    learn(received(toc_item_reply(i, LogType::kUint16, "range", kRangeVariables[i] + 6)));
  const Bytes all{2, 0, 0, 2, 1, 0, 2, 2, 0, 2, 3, 0};
  make(1, all);
  make(4, {2, 0, 0});
  make(5, all);
  int taken_4 = 0;
  int taken_5 = 0;
  for (int at_ms = 1000; at_ms < 6000; at_ms += 100) {
    const auto stamp = static_cast<std::uint32_t>(at_ms);
    taken_4 += extract(LogPacket(4, stamp).u16(1000), host_ms(at_ms)) ? 1 : 0;
    taken_5 +=
        extract(LogPacket(5, stamp).u16(1000).u16(1000).u16(1000).u16(1000), host_ms(at_ms + 5)) ? 1 : 0;
  }
  EXPECT_EQ(taken_4, 0);
  EXPECT_GT(taken_5, 25);
}

TEST_F(RunningBlocksTest, TheRangesAreTakenFromTheOneThatHoldsMost) {
  for (std::uint16_t i = 0; i < 4; ++i)
    learn(received(toc_item_reply(i, LogType::kUint16, "range", kRangeVariables[i] + 6)));
  make(1, {2, 0, 0});
  make(2, {2, 0, 0, 2, 1, 0, 2, 2, 0, 2, 3, 0}, 50);
  EXPECT_FALSE(extract(LogPacket(1, 100).u16(1000)));
  const auto reading = extract(LogPacket(2, 110).u16(1000).u16(2000).u16(3000).u16(4000));
  ASSERT_TRUE(reading.has_value());
  EXPECT_THAT(reading->distance_m, ElementsAre(1.F, 2.F, 3.F, 4.F));
  EXPECT_FALSE(extract(LogPacket(1, 120).u16(1000)));
  EXPECT_TRUE(extractor_.missing_ranges().empty());
  EXPECT_EQ(extractor_.range_period(), std::chrono::milliseconds(500));
}

TEST_F(RunningBlocksTest, ThePositionIsTakenFromNoneThatIsSlowerThanAnother) {
  learn(received(toc_item_reply(0, LogType::kFloat, "stateEstimate", "x")));
  learn(received(toc_item_reply(1, LogType::kFloat, "stateEstimate", "y")));
  const Bytes position{7, 0, 0, 7, 1, 0};
  make(1, position, 100);
  make(2, position, 10);
  make(16, position, 1);  // of a client, which comes and goes: no better than as often as ranges are measured
  EXPECT_FALSE(extract(LogPacket(1, 100).f32(1.F).f32(1.F)));
  EXPECT_FALSE(extract(LogPacket(16, 110).f32(1.F).f32(1.F)));
  EXPECT_TRUE(extract(LogPacket(2, 110).f32(1.F).f32(1.F)));
}

TEST_F(RunningBlocksTest, WhetherTheVehicleFliesIsTakenFromOne) {
  learn(received(toc_item_reply(0, LogType::kUint16, "supervisor", "info")));
  learn(received(toc_item_reply(1, LogType::kFloat, "stabilizer", "thrust")));
  make(1, {2, 0, 0});
  make(16, {7, 1, 0});
  EXPECT_FALSE(extract(LogPacket(16, 100).f32(0.F)));
  EXPECT_EQ(extract(LogPacket(1, 110).u16(0x0018))->is_flying, true);
  EXPECT_FALSE(extract(LogPacket(16, 120).f32(0.F)));
}

TEST_F(ReadingExtractorTest, UnwrapsMillimetresBeyondSixteenBits) {
  describe(1, {{"stateEstimateZ.x", LogType::kInt16}, {"stateEstimateZ.y", LogType::kInt16}});
  EXPECT_NEAR(extract(LogPacket(1, 10).i16(32'700).i16(-32'700))->position_odom->x_m, 32.7, 1e-12);
  const auto wrapped = extract(LogPacket(1, 20).i16(-32'736).i16(32'736));
  EXPECT_NEAR(wrapped->position_odom->x_m, 32.8, 1e-12);
  EXPECT_NEAR(wrapped->position_odom->y_m, -32.8, 1e-12);
}

TEST_F(ReadingExtractorTest, ExtractsNothingFromOtherVariables) {
  describe(1, {{"pm.vbatMV", LogType::kUint16}, {"stateEstimate.x", LogType::kHalf}});
  EXPECT_FALSE(extract(LogPacket(1, 10).u16(4000).u16(0)).has_value());
  EXPECT_FALSE(extractor_.finds_position());
}

}  // namespace
}  // namespace swiftlet
