// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_monitor.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

/// Block 1: supervisor.info, pm.vbatMV; block 2: pm.vbat, sys.isFlying; block 3: pm.state, radio.rssi.
class VehicleMonitorTest : public testing::Test {
 protected:
  VehicleMonitorTest() {
    for (const auto& reply : {toc_item_reply(0, LogType::kUint16, "supervisor", "info"),
                              toc_item_reply(1, LogType::kUint16, "pm", "vbatMV"),
                              toc_item_reply(2, LogType::kInt8, "pm", "state"),
                              toc_item_reply(3, LogType::kUint8, "radio", "rssi"),
                              toc_item_reply(4, LogType::kFloat, "pm", "vbat"),
                              toc_item_reply(5, LogType::kUint8, "sys", "isFlying")})
      static_cast<void>(session_.on_frame(received(reply)));
    for (const char* request :
         {"5d 06 01 02 00 00 02 01 00", "5d 06 02 07 04 00 01 05 00", "5d 06 03 04 02 00 01 03 00"}) {
      static_cast<void>(session_.on_frame(sent(hex(request))));
      Bytes reply = hex(request);
      reply.resize(3);
      reply.push_back(0);
      static_cast<void>(session_.on_frame(received(reply)));
    }
  }
  void on_frame(const Bytes& packet) {
    const auto frame = received(packet);  // the record views it
    const auto record = session_.on_frame(frame);
    ASSERT_TRUE(record.has_value());
    monitor_.on_frame(*record);
  }
  void on_state(std::uint16_t supervisor, std::uint16_t millivolts, std::uint32_t at_ms = 100) {
    on_frame(LogPacket(1, at_ms).u16(supervisor).u16(millivolts).bytes());
  }

  LogSession session_;
  VehicleMonitor monitor_{session_};
};

constexpr std::uint16_t kFlying = 1U << 4U;

TEST_F(VehicleMonitorTest, ReadsTheHealthFromTheLog) {
  EXPECT_FALSE(monitor_.health().is_flying.has_value());
  on_state(kFlying, 3870);
  on_frame(LogPacket(3, 100).u16(0x2D01).bytes());
  EXPECT_EQ(monitor_.health().is_flying, true);
  EXPECT_EQ(monitor_.health().battery_mv, 3870);
  EXPECT_EQ(monitor_.health().rssi_dbm, -45);
  EXPECT_FALSE(monitor_.health().battery_is_low);
}

/// Block 5: the ranges, beside block 1.
class FrozenRangesTest : public VehicleMonitorTest {
 protected:
  FrozenRangesTest() {
    std::uint16_t id = 4;
    for (const char* name : {"front", "left", "back", "right"})
      static_cast<void>(session_.on_frame(received(toc_item_reply(id++, LogType::kUint16, "range", name))));
    static_cast<void>(session_.on_frame(sent(hex("5d 06 05 02 04 00 02 05 00 02 06 00 02 07 00"))));
    static_cast<void>(session_.on_frame(received(hex("5d 06 05 00"))));
  }
  /// For that long, ten times a second; `front_step_mm` a packet.
  bool warns_within(int duration_ms, std::uint16_t front_step_mm = 0) {
    bool warned = false;
    for (const int end_ms = now_ms_ + duration_ms; now_ms_ < end_ms; now_ms_ += 100) {
      front_mm_ = static_cast<std::uint16_t>(front_mm_ + front_step_mm);
      on_frame(LogPacket(5, static_cast<std::uint32_t>(now_ms_))
                   .u16(front_mm_)
                   .u16(32766)
                   .u16(back_mm_)
                   .u16(32766)
                   .bytes());
      while (const auto event = monitor_.take_event())
        warned = warned || event->kind == VehicleEvent::Kind::kRangesFrozen;
    }
    return warned;
  }

  std::uint16_t front_mm_ = 2000;
  std::uint16_t back_mm_ = 1200;

 private:
  int now_ms_ = 1000;
};

TEST_F(FrozenRangesTest, AreReportedOnceUntilTheyMoveAgain) {
  on_state(kFlying, 3800);
  EXPECT_FALSE(warns_within(5000, 1));
  EXPECT_FALSE(warns_within(1900));
  EXPECT_TRUE(warns_within(500));
  EXPECT_FALSE(warns_within(5000));
  EXPECT_FALSE(warns_within(500, 1));
  EXPECT_TRUE(warns_within(2500));
}

TEST_F(FrozenRangesTest, AreNotReportedOnTheGroundOrWithNothingInReach) {
  on_state(0, 3800);
  EXPECT_FALSE(warns_within(5000));
  on_state(kFlying, 3800, 6000);
  EXPECT_FALSE(warns_within(1900));
  front_mm_ = 32766;
  back_mm_ = 0;
  EXPECT_FALSE(warns_within(5000));
}

TEST_F(VehicleMonitorTest, ReadsTheNamesOfOtherFirmware) {
  on_frame(LogPacket(2, 100).f32(3.8749F).u8(1).bytes());
  EXPECT_EQ(monitor_.health().battery_mv, 3875);
  EXPECT_EQ(monitor_.health().is_flying, true);
  on_frame(LogPacket(2, 200).f32(3.7F).u8(0).bytes());
  EXPECT_EQ(monitor_.health().is_flying, false);
}

TEST_F(VehicleMonitorTest, WarnsOnceOfALowBattery) {
  on_state(kFlying, 3150);
  on_frame(LogPacket(3, 100).u16(0x2D03).bytes());
  const auto event = monitor_.take_event();
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->kind, VehicleEvent::Kind::kBatteryLow);
  EXPECT_EQ(event->value, 3150);
  on_frame(LogPacket(3, 200).u16(0x2D03).bytes());
  EXPECT_FALSE(monitor_.take_event().has_value());
}

TEST_F(VehicleMonitorTest, WarnsOfTheYawTrapWhenCarriedNotWhenFlownOrStanding) {
  on_state(kFlying, 3800);
  monitor_.on_odometry(Pose2(0.0, 0.0, 0.0));
  monitor_.on_odometry(Pose2(5.0, 0.0, 2.0));
  EXPECT_FALSE(monitor_.take_event().has_value());
  on_state(0, 3800);
  monitor_.on_odometry(Pose2(5.0, 0.0, 2.0));
  monitor_.on_odometry(Pose2(5.1, 0.0, 2.1));
  EXPECT_FALSE(monitor_.take_event().has_value());
  monitor_.on_odometry(Pose2(5.1, 0.0, 2.7));
  const auto event = monitor_.take_event();
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->kind, VehicleEvent::Kind::kYawTrap);
  monitor_.on_odometry(Pose2(6.1, 0.0, 2.7));
  EXPECT_FALSE(monitor_.take_event().has_value());
}

}  // namespace
}  // namespace swiftlet
