// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/usb_cable_link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"
#include "tests/firmware_link/scripted_uplink.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A bus with vehicles on cables, all of them the same one, and other devices of that number.
class FakeCable final : public UsbBus {
 public:
  struct Switch {
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    bool operator==(const Switch&) const = default;
  };

  explicit FakeCable(ManualLinkClock& link_clock) : clock(link_clock) { plug_in("Bitcraze AB"); }
  void plug_in(const std::string& manufacturer) {
    UsbIdentity identity;
    identity.vendor = 0x0483;
    identity.product = 0x5740;
    identity.address = static_cast<std::uint8_t>(plugged_in.size());
    identity.manufacturer = manufacturer;
    identity.serial = "36002E00075138343038383" + std::to_string(plugged_in.size());
    plugged_in.push_back(identity);
  }

  ManualLinkClock& clock;
  std::vector<UsbIdentity> plugged_in;
  UsbOutcome opening = UsbOutcome::kDone;
  std::deque<UsbOutcome> out_outcomes;  ///< of the next transfers; kDone beyond
  std::deque<UsbOutcome> in_outcomes;
  std::vector<Switch> switches;
  std::vector<Bytes> sent;
  std::deque<Bytes> waiting;  ///< to be received
  std::vector<std::uint8_t> cleared;
  std::vector<int> opened;  ///< addresses
  int interface = -1;

  std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override {
    EXPECT_EQ(vendor, 0x0483);
    EXPECT_EQ(product, 0x5740);
    return plugged_in;
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                            int claimed) override {
    if (opening != UsbOutcome::kDone) return opening;
    interface = claimed;
    opened.push_back(identity.address);
    return std::make_unique<Device>(*this, identity.address);
  }
  bool has_changed() override { return false; }

 private:
  class Device final : public UsbDevice {
   public:
    Device(FakeCable& cable, std::uint8_t address) : cable_(cable), address_(address) {}
    UsbTransfer control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                            std::span<const std::uint8_t> /*data*/, Duration /*timeout*/) override {
      cable_.switches.push_back({request, value, index});
      return {};
    }
    UsbTransfer bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes,
                         Duration /*timeout*/) override {
      EXPECT_EQ(endpoint, 0x01);
      const UsbOutcome outcome = next(cable_.out_outcomes);
      if (outcome == UsbOutcome::kDone) cable_.sent.emplace_back(bytes.begin(), bytes.end());
      return {outcome, bytes.size()};
    }
    UsbTransfer bulk_in(std::uint8_t endpoint, std::span<std::uint8_t> buffer, Duration timeout) override {
      EXPECT_EQ(endpoint, 0x81);
      EXPECT_EQ(buffer.size(), 64U);
      if (std::ranges::count(cable_.plugged_in, address_, &UsbIdentity::address) == 0)
        return {UsbOutcome::kNoDevice, 0};
      const UsbOutcome outcome = next(cable_.in_outcomes);
      if (outcome != UsbOutcome::kDone) return {outcome, 0};
      if (cable_.waiting.empty()) {
        cable_.clock.sleep_for(timeout);
        return {UsbOutcome::kTimeout, 0};
      }
      cable_.clock.sleep_for(milliseconds(1));
      const Bytes packet = cable_.waiting.front();
      cable_.waiting.pop_front();
      std::ranges::copy(packet, buffer.begin());
      return {UsbOutcome::kDone, packet.size()};
    }
    UsbOutcome clear_halt(std::uint8_t endpoint) override {
      cable_.cleared.push_back(endpoint);
      return UsbOutcome::kDone;
    }
    UsbOutcome reset() override { return UsbOutcome::kFault; }

   private:
    static UsbOutcome next(std::deque<UsbOutcome>& outcomes) {
      if (outcomes.empty()) return UsbOutcome::kDone;
      const UsbOutcome outcome = outcomes.front();
      outcomes.pop_front();
      return outcome;
    }
    FakeCable& cable_;
    std::uint8_t address_;
  };
};

class UsbCableLinkTest : public testing::Test {
 protected:
  std::vector<LinkFrame> listen(Duration duration) {
    std::vector<LinkFrame> frames;
    const HostTime end = clock_.now() + duration;
    while (clock_.now() < end) {
      const Result<LinkFrame> frame = link_->receive(end - clock_.now());
      if (frame)
        frames.push_back(*frame);
      else
        EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
    }
    return frames;
  }
  LinkCondition condition() { return link_->statistics().condition; }

  ManualLinkClock clock_;
  FakeCable cable_{clock_};
  std::optional<UsbCableLink> link_{std::in_place, cable_, clock_, 0};
};

TEST_F(UsbCableLinkTest, AClientsPacketsGoFirstAndDoNotKeepTheVehiclesWaiting) {
  ScriptedUplink client({0x3C, 1}, 1000);
  link_->uplink()->share_with(client);
  ASSERT_TRUE(link_->send(hex("5d 05")).ok());
  for (int i = 0; i < 20; ++i) cable_.waiting.push_back(hex("52 01 00 00 00"));
  const std::vector<LinkFrame> frames = listen(milliseconds(20));
  ASSERT_EQ(frames.size(), 40U);
  EXPECT_EQ(std::ranges::count(frames, false, &LinkFrame::is_ours), 20);
  EXPECT_EQ(std::ranges::count(frames, LinkDirection::kFromVehicle, &LinkFrame::direction), 20);
  client.left = 0;
  const std::vector<LinkFrame> after = listen(milliseconds(2));
  ASSERT_EQ(after.size(), 1U);
  EXPECT_TRUE(after[0].is_ours);
}

TEST_F(UsbCableLinkTest, SwitchesTheVehicleToTheCableAndBack) {
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(cable_.switches, (std::vector<FakeCable::Switch>{{1, 1, 1}}));
  EXPECT_EQ(cable_.interface, 0);
  link_.reset();
  EXPECT_EQ(cable_.switches, (std::vector<FakeCable::Switch>{{1, 1, 1}, {1, 1, 0}}));
}

TEST_F(UsbCableLinkTest, DeliversEachPacketInOrderAndNoNullPackets) {
  cable_.waiting = {{0xF3}, {0x50, 3, 1}, {}, Bytes(40, 0x50), {0x52, 1}};
  const HostTime asked_at = clock_.now();
  ASSERT_TRUE(link_->send(Bytes{0x5C, 3}).ok());
  const std::vector<LinkFrame> frames = listen(milliseconds(100));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].direction, LinkDirection::kToVehicle);
  EXPECT_EQ(frames[0].at, asked_at);
  EXPECT_EQ(cable_.sent, (std::vector<Bytes>{{0x5C, 3}}));
  EXPECT_EQ(Bytes(frames[1].packet().begin(), frames[1].packet().end()), (Bytes{0x50, 3, 1}));
  EXPECT_EQ(frames[1].direction, LinkDirection::kFromVehicle);
  EXPECT_EQ(frames[1].at - asked_at, milliseconds(2));
  EXPECT_EQ(frames[2].size, 2);
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  EXPECT_EQ(link_->statistics().packets_sent, 1U);
  EXPECT_EQ(link_->statistics().packets_acked, 1U);
  EXPECT_EQ(link_->statistics().packets_received, 2U);
}

TEST_F(UsbCableLinkTest, RefusesInvalidPacketsAndNullPackets) {
  EXPECT_EQ(link_->send({}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(link_->send(Bytes(32, 0x5C)).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(link_->send(Bytes{0xFF, 0xFE, 0x01}).error().code, ErrorCode::kInvalidInput);
}

TEST_F(UsbCableLinkTest, IgnoresOtherDevicesWithThatNumber) {
  cable_.plugged_in.clear();
  cable_.plug_in("STMicroelectronics");
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  cable_.plug_in("Bitcraze AB");
  cable_.plug_in("Bitcraze AB");
  static_cast<void>(listen(milliseconds(1100)));
  EXPECT_EQ(cable_.opened, std::vector<int>{1});
  link_.emplace(cable_, clock_, 1);
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(cable_.opened, (std::vector<int>{1, 2}));
  link_.emplace(cable_, clock_, 2);
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
}

TEST_F(UsbCableLinkTest, ReportsWhyTheVehicleCannotBeOpened) {
  cable_.opening = UsbOutcome::kBusy;
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceBusy);
  cable_.plugged_in[0].manufacturer.clear();
  cable_.plugged_in[0].access = UsbOutcome::kAccessDenied;
  static_cast<void>(listen(milliseconds(1100)));
  EXPECT_EQ(condition(), LinkCondition::kAccessDenied);
}

TEST_F(UsbCableLinkTest, ReportsSilence) {
  cable_.waiting = {{0x52, 1}};
  static_cast<void>(listen(milliseconds(900)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  static_cast<void>(listen(milliseconds(300)));
  EXPECT_EQ(condition(), LinkCondition::kSilent);
  EXPECT_EQ(link_->statistics().silences, 1U);
  EXPECT_EQ(link_->statistics().usb_timeouts, 0U) << "having nothing to send is no fault";
  cable_.waiting = {{0x52, 2}};
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
}

TEST_F(UsbCableLinkTest, ReopensTheVehicleAfterItWasUnplugged) {
  static_cast<void>(listen(milliseconds(100)));
  const std::vector<UsbIdentity> vehicles = std::exchange(cable_.plugged_in, {});
  const HostTime asked_at = clock_.now();
  EXPECT_TRUE(listen(seconds(3)).empty());
  EXPECT_EQ(clock_.now() - asked_at, seconds(3));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  cable_.plugged_in = vehicles;
  cable_.waiting = {{0x52, 1}};
  EXPECT_EQ(listen(milliseconds(1100)).size(), 1U);
  EXPECT_EQ(cable_.switches, (std::vector<FakeCable::Switch>{{1, 1, 1}, {1, 1, 1}}));
  EXPECT_EQ(link_->statistics().device_losses, 1U);
}

TEST_F(UsbCableLinkTest, WaitsForItsOwnVehicleAndLeavesAnotherAlone) {
  cable_.plug_in("Bitcraze AB");
  static_cast<void>(listen(milliseconds(100)));
  UsbIdentity own = cable_.plugged_in[0];
  cable_.plugged_in.erase(cable_.plugged_in.begin());
  static_cast<void>(listen(seconds(3)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  own.address = 9;
  cable_.plugged_in.push_back(own);
  static_cast<void>(listen(milliseconds(1100)));
  EXPECT_EQ(cable_.opened, (std::vector<int>{0, 9}));
}

TEST_F(UsbCableLinkTest, ContinuesAfterStallsAndGivesUpAfterTen) {
  static_cast<void>(listen(milliseconds(100)));
  cable_.in_outcomes = {UsbOutcome::kStall, UsbOutcome::kStall};
  cable_.waiting = {{0x52, 1}};
  EXPECT_EQ(listen(milliseconds(50)).size(), 1U);
  EXPECT_EQ(cable_.cleared, (Bytes{0x81, 0x81}));
  EXPECT_EQ(link_->statistics().device_losses, 0U);
  cable_.in_outcomes.assign(10, UsbOutcome::kStall);
  static_cast<void>(listen(milliseconds(50)));
  EXPECT_EQ(link_->statistics().device_losses, 1U);
  EXPECT_EQ(condition(), LinkCondition::kDeviceStalls);
}

TEST_F(UsbCableLinkTest, DropsARequestThatTheVehicleDoesNotAccept) {
  cable_.out_outcomes = {UsbOutcome::kTimeout, UsbOutcome::kStall};
  ASSERT_TRUE(link_->send(Bytes{0x5C, 1}).ok());
  ASSERT_TRUE(link_->send(Bytes{0x5C, 2}).ok());
  ASSERT_TRUE(link_->send(Bytes{0x5C, 3}).ok());
  EXPECT_EQ(listen(milliseconds(50)).size(), 1U);
  EXPECT_EQ(cable_.sent, (std::vector<Bytes>{{0x5C, 3}}));
  EXPECT_EQ(cable_.cleared, Bytes{0x01});
  EXPECT_EQ(link_->statistics().usb_timeouts, 1U);
}

}  // namespace
}  // namespace swiftlet
