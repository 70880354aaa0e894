// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/radio_scan.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "tests/firmware_link/fake_dongle.hpp"

namespace swiftlet {
namespace {

class RadioScanTest : public testing::Test {
 protected:
  /// The last value that was set.
  [[nodiscard]] std::uint16_t setting(std::uint8_t number) const {
    std::uint16_t value = 0xFFFF;
    for (const FakeDongle::Request& request : dongle_.requests)
      if (request.number == number) value = request.value;
    return value;
  }
  [[nodiscard]] std::pair<int, int> rate_and_channel() const { return {setting(0x03), setting(0x01)}; }

  ManualLinkClock clock_;
  FakeDongle dongle_{clock_};
  RadioAddress wanted_;
};

TEST_F(RadioScanTest, FindsEachRateAndChannelThatAnswers) {
  wanted_.address = {1, 2, 3, 4, 5};
  std::set<std::pair<int, int>> asked;
  dongle_.is_in_range = [&] {
    asked.insert(rate_and_channel());
    return rate_and_channel() == std::pair(0, 125) || rate_and_channel() == std::pair(2, 80);
  };
  const auto scanned = scan_radio(dongle_, wanted_);
  ASSERT_EQ(scanned.index(), 0U);
  const std::vector<RadioAddress>& found = std::get<0>(scanned);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].rate, RadioRate::k250Kbps);
  EXPECT_EQ(found[0].channel, 125);
  EXPECT_EQ(found[1].rate, RadioRate::k2Mbps);
  EXPECT_EQ(found[1].channel, 80);
  EXPECT_EQ(found[1].address, wanted_.address);
  EXPECT_EQ(asked.size(), 3U * 126U);
  EXPECT_EQ(setting(0x06), 1) << "one retransmission";
  for (const FakeDongle::Packet& packet : dongle_.packets) EXPECT_EQ(packet.bytes, Bytes{0xFF});
}

TEST_F(RadioScanTest, SearchesWhereACrazyradio2CanTune) {
  dongle_.plugged_in[0].release_bcd = 0x0504;
  wanted_.rate = RadioRate::k250Kbps;
  wanted_.channel = 120;
  std::set<std::pair<int, int>> asked;
  dongle_.is_in_range = [&] {
    asked.insert(rate_and_channel());
    return rate_and_channel() == std::pair(1, 100);
  };
  const auto scanned = scan_radio(dongle_, wanted_);
  ASSERT_EQ(scanned.index(), 0U);
  ASSERT_EQ(std::get<0>(scanned).size(), 1U);
  EXPECT_EQ(std::get<0>(scanned)[0].channel, 100);
  EXPECT_EQ(asked.size(), 2U * 101U);
}

TEST_F(RadioScanTest, FindsNothingWithoutAVehicle) {
  dongle_.is_in_range = [] { return false; };
  dongle_.fates = {Fate::kNeverAnswered, Fate::kInStalls};
  const auto scanned = scan_radio(dongle_, wanted_);
  ASSERT_EQ(scanned.index(), 0U);
  EXPECT_TRUE(std::get<0>(scanned).empty());
}

TEST_F(RadioScanTest, ReportsWhyTheDongleCannotBeUsed) {
  dongle_.fates = {Fate::kDelivered, Fate::kFails};
  EXPECT_EQ(std::get<UsbOutcome>(scan_radio(dongle_, wanted_)), UsbOutcome::kFault);
  dongle_.opening = {UsbOutcome::kBusy};
  EXPECT_EQ(std::get<UsbOutcome>(scan_radio(dongle_, wanted_)), UsbOutcome::kBusy);
}

}  // namespace
}  // namespace swiftlet
