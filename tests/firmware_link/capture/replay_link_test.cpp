// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/replay_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReplayLink, ReplaysBothDirectionsInOrderToTheEnd) {
  const TemporaryFile file("a.pcap");
  const std::vector<LinkFrame> frames = SyntheticCapture{}.frames();
  write_capture(file.path(), frames);
  auto link = ReplayLink::open(file.path());
  ASSERT_TRUE(link.ok());
  EXPECT_LT((*link)->progress(), 0.1);
  for (const LinkFrame& expected : frames) {
    const Result<LinkFrame> frame = (*link)->receive(Duration::zero());
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->at, expected.at);
    EXPECT_EQ(frame->direction, expected.direction);
    EXPECT_EQ(frame->bytes, expected.bytes);
  }
  EXPECT_EQ((*link)->receive(Duration::zero()).error().code, ErrorCode::kEndOfRecording);
  EXPECT_EQ((*link)->progress(), 1.0);
  EXPECT_TRUE((*link)->notes().empty());
  EXPECT_TRUE((*link)->send(hex("ff")).ok());
}

TEST(ReplayLink, ReplaysTheVehicleThatSendsLogDataFirstAndReportsTheOthers) {
  const TemporaryFile file("a.pcap");
  std::string bytes = capture_bytes({sent(hex("ff"))}, radio_vehicle(0x01));
  const auto add = [&bytes](const Bytes& packet, const CaptureVehicle& vehicle) {
    bytes += capture_bytes({received(packet)}, vehicle).substr(kPcapFileHeader);
  };
  add(hex("52 01 00 00 00 01"), radio_vehicle(0x02));
  add(hex("52 01 00 00 00 02"), radio_vehicle(0x02, 90));
  add(hex("52 01 00 00 00 03"), radio_vehicle(0x02));
  file.write(bytes);
  auto link = ReplayLink::open(file.path());
  ASSERT_TRUE(link.ok());
  EXPECT_EQ((*link)->receive(Duration::zero())->packet()[5], 1);
  EXPECT_EQ((*link)->receive(Duration::zero())->packet()[5], 3);
  EXPECT_FALSE((*link)->receive(Duration::zero()).ok());
  EXPECT_THAT((*link)->notes(),
              ElementsAre("follows radio E7E7E7E702 channel 80, leaves out radio E7E7E7E701 channel 80",
                          "follows radio E7E7E7E702 channel 80, leaves out radio E7E7E7E702 channel 90"));
}

TEST(ReplayLink, PassesOverVehiclesThatSendLogDataEarlier) {
  const TemporaryFile file("a.pcap");
  std::string bytes = capture_bytes({sent(hex("ff"))}, radio_vehicle(0x01));
  for (const std::uint8_t vehicle : Bytes{3, 2, 3})
    bytes += capture_bytes({received({0x52, 1, 0, 0, 0, vehicle})}, radio_vehicle(vehicle))
                 .substr(kPcapFileHeader);
  file.write(bytes);
  for (const auto& [passed_over, vehicle] : {std::pair(0U, 3), {1U, 2}, {2U, 2}}) {
    auto link = ReplayLink::open(file.path(), passed_over);
    ASSERT_TRUE(link.ok());
    EXPECT_EQ((*link)->senders(), 2U);
    EXPECT_EQ((*link)->left_out().size(), 2U);
    EXPECT_EQ((*link)->receive(Duration::zero())->packet()[5], vehicle);
  }
}

TEST(ReplayLink, ContinuesStampsThatWrapEachMinuteByTheVehiclesClock) {
  const TemporaryFile file("a.pcap");
  std::vector<LinkFrame> written;
  std::vector<HostTime> true_times;
  // From 50 s past the minute; the link is silent for 170 s and for 12 s.
  for (const int second : {50, 51, 59, 60, 62, 119, 289, 290, 301, 313}) {
    for (const LinkFrame& frame :
         {sent(hex("ff"), host_ms(1000L * second)),
          received(LogPacket(1, static_cast<std::uint32_t>(1000 * second + 16'700'000)).u8(0).bytes(),
                   host_ms(1000L * second + 3))}) {
      true_times.push_back(frame.at);
      written.push_back(frame);
      written.back().at = HostTime((frame.at.time_since_epoch()) % std::chrono::minutes(1));
    }
  }
  write_capture(file.path(), written);
  auto link = ReplayLink::open(file.path());
  ASSERT_TRUE(link.ok());
  EXPECT_THAT((*link)->notes(), ElementsAre(HasSubstr("seconds of their minute alone")));
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Result<LinkFrame> frame = (*link)->receive(Duration::zero());
    ASSERT_TRUE(frame.ok());
    // What precedes the log data after a silence can not tell how long that was.
    if (frame->direction == LinkDirection::kToVehicle) continue;
    EXPECT_EQ(frame->at, true_times[i]) << i;
  }
}

TEST(ReplayLink, ReportsDamageAfterWhatPrecedesIt) {
  const TemporaryFile file("a.pcap");
  const std::vector<LinkFrame> frames = SyntheticCapture{}.frames();
  write_capture(file.path(), frames);
  const std::string bytes = file.read();
  file.write(std::string_view(bytes).substr(0, bytes.size() - 3));
  auto link = ReplayLink::open(file.path());
  ASSERT_TRUE(link.ok());
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) EXPECT_TRUE((*link)->receive(Duration::zero()).ok());
  const auto end = (*link)->receive(Duration::zero());
  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().code, ErrorCode::kDamaged);
  EXPECT_THAT(end.error().message, HasSubstr("damaged at byte "));
}

TEST(ReplayLink, RefusesACaptureWithoutAPacket) {
  const TemporaryFile file("a.pcap");
  write_capture(file.path(), {});
  const auto link = ReplayLink::open(file.path());
  ASSERT_FALSE(link.ok());
  EXPECT_THAT(link.error().message, HasSubstr("without a single packet"));
}

}  // namespace
}  // namespace swiftlet
