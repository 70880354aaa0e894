// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/radio_link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "tests/firmware_link/fake_dongle.hpp"
#include "tests/firmware_link/scripted_uplink.hpp"
#include "tests/support/allocation_counter.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class RadioLinkTest : public testing::Test {
 protected:
  RadioLink& link() {
    if (!link_) link_.emplace(dongle_, clock_, address_);
    return *link_;
  }
  /// Everything that is delivered in that time.
  std::vector<LinkFrame> listen(Duration duration) {
    std::vector<LinkFrame> frames;
    const HostTime end = clock_.now() + duration;
    while (clock_.now() < end) {
      const Result<LinkFrame> frame = link().receive(end - clock_.now());
      if (frame) frames.push_back(*frame);
    }
    return frames;
  }
  void connect() {
    static_cast<void>(listen(milliseconds(50)));
    ASSERT_EQ(link().statistics().condition, LinkCondition::kConnected);
    dongle_.packets.clear();
  }
  /// Times between the packets sent in that time.
  std::vector<Duration> pauses_in(Duration duration) {
    dongle_.packets.clear();
    static_cast<void>(listen(duration));
    std::vector<Duration> pauses;
    for (std::size_t i = 1; i < dongle_.packets.size(); ++i)
      pauses.push_back(dongle_.packets[i].at - dongle_.packets[i - 1].at);
    EXPECT_FALSE(pauses.empty());
    return pauses;
  }
  std::vector<Bytes> sent() const {
    std::vector<Bytes> packets;
    for (const FakeDongle::Packet& packet : dongle_.packets) packets.push_back(packet.bytes);
    return packets;
  }
  int safelink_requests() const {
    return static_cast<int>(std::ranges::count(sent(), Bytes{0xFF, 0x05, 0x01}));
  }
  LinkCondition condition() { return link().statistics().condition; }

  ManualLinkClock clock_;
  FakeDongle dongle_{clock_};
  RadioAddress address_;
  std::optional<RadioLink> link_;
};

/// Acknowledges with the packet itself, now and then too late; itself without allocation.
class AckingBus final : public UsbBus {
 public:
  explicit AckingBus(LinkClock& clock) : clock_(clock) {}
  std::vector<UsbIdentity> list(std::uint16_t /*vendor*/, std::uint16_t /*product*/) override {
    UsbIdentity identity;
    identity.release_bcd = 0x0504;
    return {identity};
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& /*identity*/,
                                                            int /*interface*/) override {
    return std::make_unique<Device>(clock_);
  }
  bool has_changed() override { return false; }

 private:
  class Device final : public UsbDevice {
   public:
    explicit Device(LinkClock& clock) : clock_(clock) {}
    UsbTransfer control_out(std::uint8_t, std::uint16_t, std::uint16_t, std::span<const std::uint8_t>,
                            Duration) override {
      return {};
    }
    UsbTransfer bulk_out(std::uint8_t, std::span<const std::uint8_t> bytes, Duration) override {
      size_ = bytes.size() + 1;
      answer_[0] = 0x01;
      std::ranges::copy(bytes, answer_.begin() + 1);
      return {UsbOutcome::kDone, bytes.size()};
    }
    UsbTransfer bulk_in(std::uint8_t, std::span<std::uint8_t> buffer, Duration timeout) override {
      const std::size_t size = ++reads_ % 10 == 0 ? 0 : std::exchange(size_, 0);
      clock_.sleep_for(size == 0 ? timeout : Duration(milliseconds(1)));
      std::copy_n(answer_.begin(), size, buffer.begin());
      return {size == 0 ? UsbOutcome::kTimeout : UsbOutcome::kDone, size};
    }
    UsbOutcome clear_halt(std::uint8_t) override { return UsbOutcome::kDone; }
    UsbOutcome reset() override { return UsbOutcome::kDone; }

   private:
    LinkClock& clock_;
    std::array<std::uint8_t, 64> answer_{};
    std::size_t size_ = 0;
    int reads_ = 0;
  };
  LinkClock& clock_;
};

Bytes bytes_of(const LinkFrame& frame) { return {frame.packet().begin(), frame.packet().end()}; }
std::vector<Bytes> packets_of(const std::vector<LinkFrame>& frames, LinkDirection direction) {
  std::vector<Bytes> packets;
  for (const LinkFrame& frame : frames) {
    if (frame.direction != direction) continue;
    packets.push_back(bytes_of(frame));
    packets.back()[0] &= 0xF3;
  }
  return packets;
}

TEST_F(RadioLinkTest, AClientsPacketIsTheNextOneAndAnUnacknowledgedOneIsRepeatedAtOnce) {
  connect();
  ASSERT_TRUE(link().send(Bytes{0x5D, 5}).ok());
  ScriptedUplink client({0x3C, 1}, 1);
  link().uplink()->share_with(client);
  dongle_.fates = {Fate::kPacketLost, Fate::kPacketLost};
  const std::vector<LinkFrame> frames = listen(milliseconds(10));
  ASSERT_GE(frames.size(), 2U);
  EXPECT_FALSE(frames[0].is_ours);
  EXPECT_EQ(frames[0].packet()[1], 1);
  EXPECT_TRUE(frames[1].is_ours);
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 2U);
  ASSERT_GE(dongle_.packets.size(), 4U);
  EXPECT_LT(dongle_.packets[2].at - dongle_.packets[0].at, milliseconds(4));
}

TEST_F(RadioLinkTest, AClientsRequestThatASilenceLeftUnacknowledgedReachesTheVehicleBehindIt) {
  connect();
  ScriptedUplink client({0x2D, 1, 0}, 1);
  link().uplink()->share_with(client);
  dongle_.is_in_range = [] { return false; };
  EXPECT_EQ(listen(milliseconds(1500)).size(), 1U);
  EXPECT_TRUE(dongle_.vehicle.accepted.empty());
  dongle_.is_in_range = [] { return true; };
  static_cast<void>(listen(milliseconds(100)));
  ASSERT_EQ(dongle_.vehicle.accepted.size(), 1U);
  EXPECT_EQ(dongle_.vehicle.accepted[0][1], 1);
}

TEST_F(RadioLinkTest, AClientsRequestThatAPulledDongleLeftUnacknowledgedReachesTheVehicleBehindIt) {
  connect();
  ScriptedUplink client({0x2D, 1, 0}, 1);
  link().uplink()->share_with(client);
  dongle_.fates.assign(5, Fate::kPacketLost);
  EXPECT_EQ(listen(milliseconds(2)).size(), 1U);
  const std::vector<UsbIdentity> dongles = std::exchange(dongle_.plugged_in, {});
  dongle_.has_news = true;
  static_cast<void>(listen(milliseconds(300)));
  EXPECT_TRUE(dongle_.vehicle.accepted.empty());
  dongle_.plugged_in = dongles;
  dongle_.has_news = true;
  static_cast<void>(listen(milliseconds(1500)));
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 1U);
}

TEST_F(RadioLinkTest, RequestsSafelinkAndIsConnected) {
  EXPECT_EQ(condition(), LinkCondition::kSilent);
  EXPECT_TRUE(listen(milliseconds(50)).empty()) << "null packets are not handed back";
  EXPECT_EQ(sent()[0], (Bytes{0xFF, 0x05, 0x01}));
  EXPECT_EQ(sent()[1], Bytes{0xF3});
  EXPECT_EQ(safelink_requests(), 1);
  const LinkStatistics statistics = link().statistics();
  EXPECT_EQ(statistics.condition, LinkCondition::kConnected);
  EXPECT_TRUE(statistics.safelink);
  EXPECT_EQ(statistics.packets_sent, dongle_.packets.size());
  EXPECT_EQ(statistics.packets_acked, dongle_.packets.size());
  EXPECT_EQ(statistics.packets_received, 0U);
  EXPECT_EQ(statistics.silences, 0U);
}

TEST_F(RadioLinkTest, RequestsSafelinkAgainWithAPollBetweenWhenTheEchoIsLost) {
  dongle_.fates = {Fate::kAcknowledgementLost};
  static_cast<void>(listen(milliseconds(50)));
  ASSERT_GE(dongle_.packets.size(), 3U);
  EXPECT_EQ(sent()[1], Bytes{0xFF});
  EXPECT_EQ(sent()[2], (Bytes{0xFF, 0x05, 0x01}));
  EXPECT_TRUE(link().statistics().safelink);
}

TEST_F(RadioLinkTest, GivesUpSafelinkAfterTenAnswersThatAreNoEcho) {
  dongle_.vehicle.knows_safelink = false;
  static_cast<void>(listen(milliseconds(500)));
  EXPECT_EQ(safelink_requests(), 10);
  EXPECT_FALSE(link().statistics().safelink);
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  dongle_.vehicle.waiting = {{0x50, 1}, {0x50, 2}};
  EXPECT_EQ(packets_of(listen(milliseconds(20)), LinkDirection::kFromVehicle).size(), 2U);
}

TEST_F(RadioLinkTest, TellsTheVehicleToDoWithoutSafelinkIfTheUserSwitchedItOff) {
  address_.safelink = false;
  const auto listen_again = [this] {
    dongle_.packets.clear();
    static_cast<void>(listen(milliseconds(100)));
    EXPECT_EQ(safelink_requests(), 0);
    EXPECT_EQ(std::ranges::count(sent(), Bytes{0xFF, 0x05, 0x00}), 1);
    EXPECT_EQ(std::ranges::count(sent(), Bytes{0xFF}), std::ssize(sent()) - 1);
    EXPECT_FALSE(link().statistics().safelink);
    EXPECT_EQ(condition(), LinkCondition::kConnected);
  };
  listen_again();
  dongle_.is_in_range = [] { return false; };
  static_cast<void>(listen(milliseconds(3010)));
  dongle_.is_in_range = [] { return true; };
  listen_again();
}

TEST_F(RadioLinkTest, ReceivesEveryPacketWithoutSafelinkAfterAProgramThatUsedIt) {
  dongle_.vehicle.has_safelink = true;  // it keeps that until it is switched off
  address_.safelink = false;
  connect();
  dongle_.vehicle.waiting = {{0x50, 1}, {0x50, 2}, {0x50, 3}};
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  const std::vector<LinkFrame> frames = listen(milliseconds(100));
  EXPECT_EQ(packets_of(frames, LinkDirection::kFromVehicle),
            (std::vector<Bytes>{{0x50, 1}, {0x50, 2}, {0x50, 3}}));
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 1U);
}

TEST_F(RadioLinkTest, DeliversARequestOnceAndBeforeItsAnswer) {
  connect();
  const HostTime asked_at = clock_.now();
  dongle_.vehicle.waiting = {{0x50, 3}};
  dongle_.fates = {Fate::kPacketLost, Fate::kAcknowledgementLost};
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  const std::vector<LinkFrame> frames = listen(milliseconds(50));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].direction, LinkDirection::kToVehicle);
  EXPECT_EQ(bytes_of(frames[0]), sent()[0]);
  EXPECT_EQ(frames[0].at, dongle_.packets[0].at);
  EXPECT_LE(frames[0].at - asked_at, milliseconds(5))
      << "the first transmission, not the one that got through";
  EXPECT_EQ(frames[1].direction, LinkDirection::kFromVehicle);
  EXPECT_GT(frames[1].at, dongle_.packets[2].at);
  EXPECT_EQ(sent()[0], sent()[1]);
  EXPECT_EQ(sent()[0], sent()[2]);
  EXPECT_NE(sent()[0], sent()[3]);
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 1U);
}

TEST_F(RadioLinkTest, LosesAndDuplicatesNothingWithSafelink) {
  connect();
  std::mt19937 random(7);
  const std::vector<Fate> kinds{Fate::kDelivered,           Fate::kDelivered, Fate::kPacketLost,
                                Fate::kAcknowledgementLost, Fate::kInStalls,  Fate::kOutStalls};
  std::vector<Bytes> up;
  std::vector<Bytes> down;
  std::vector<LinkFrame> frames;
  for (std::uint8_t i = 0; i < 100; ++i) {
    dongle_.fates.clear();
    for (int k = 0; k < 6; ++k) dongle_.fates.push_back(kinds[random() % kinds.size()]);
    if (i % 5 == 0) dongle_.fates[random() % 6] = Fate::kAnsweredLate;
    up.push_back({0x51, i});
    down.push_back({0x52, i});
    ASSERT_TRUE(link().send(up.back()).ok());
    dongle_.vehicle.waiting.push_back(down.back());
    const std::vector<LinkFrame> more = listen(milliseconds(40));
    frames.insert(frames.end(), more.begin(), more.end());
  }
  const std::vector<LinkFrame> rest = listen(milliseconds(500));
  frames.insert(frames.end(), rest.begin(), rest.end());
  EXPECT_EQ(packets_of(frames, LinkDirection::kToVehicle), up);
  EXPECT_EQ(packets_of(frames, LinkDirection::kFromVehicle), down);
  std::vector<Bytes> accepted = dongle_.vehicle.accepted;
  for (Bytes& packet : accepted) packet[0] &= 0xF3;
  EXPECT_EQ(accepted, up);
  EXPECT_GT(link().statistics().usb_timeouts, 0U);
  EXPECT_EQ(link().statistics().device_losses, 0U);
}

TEST_F(RadioLinkTest, DoesNotRepeatARequestWithoutSafelink) {
  address_.safelink = false;
  connect();
  dongle_.fates = {Fate::kAcknowledgementLost};
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  const std::vector<LinkFrame> frames = listen(milliseconds(100));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(bytes_of(frames[0]), (Bytes{0x5C, 3}));
  EXPECT_EQ(std::ranges::count(sent(), Bytes{0x5C, 3}), 1);
}

TEST_F(RadioLinkTest, SendsARequestOnceThatIsRepeatedWhileItWaits) {
  connect();
  dongle_.fates.assign(40, Fate::kPacketLost);
  std::vector<LinkFrame> frames;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
    const std::vector<LinkFrame> more = listen(milliseconds(30));
    frames.insert(frames.end(), more.begin(), more.end());
  }
  EXPECT_EQ(frames.size(), 1U);
  EXPECT_TRUE(listen(milliseconds(200)).empty());
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 1U);
}

TEST_F(RadioLinkTest, RefusesInvalidPacketsAndNullPackets) {
  EXPECT_EQ(link().send({}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(link().send(Bytes(32, 0x5C)).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(link().send(Bytes{0xFF, 0xFE, 0x01}).error().code, ErrorCode::kInvalidInput)
      << "it would switch the vehicle off";
  EXPECT_TRUE(link().send(Bytes(31, 0x5C)).ok());
  for (std::uint8_t i = 0; i < 100; ++i) EXPECT_TRUE(link().send(Bytes{0x5C, i}).ok());
  EXPECT_EQ(listen(milliseconds(200)).size(), RequestQueue::kCapacity);
}

TEST_F(RadioLinkTest, RequestsSafelinkAgainAfterARunOfRepeats) {
  connect();
  dongle_.vehicle.has_safelink = false;  // it has rebooted without a silence
  for (std::uint8_t i = 0; i < 100; ++i) dongle_.vehicle.waiting.push_back({0x50, i});
  const std::size_t received = listen(milliseconds(500)).size();
  EXPECT_EQ(safelink_requests(), 1);
  EXPECT_TRUE(dongle_.vehicle.has_safelink);
  EXPECT_EQ(link().statistics().duplicates, 5U);
  EXPECT_EQ(received, 95U);
}

TEST_F(RadioLinkTest, RequestsSafelinkAgainWhenRepeatsAreMixedWithIdleAnswers) {
  connect();
  dongle_.vehicle.has_safelink = false;
  for (std::uint8_t i = 0; i < 50 && safelink_requests() == 0; ++i) {
    dongle_.vehicle.waiting.push_back({0x50, i});
    static_cast<void>(listen(milliseconds(41 + 5 * (i % 3))));
  }
  EXPECT_TRUE(dongle_.vehicle.has_safelink);
  EXPECT_TRUE(link().statistics().safelink);
}

TEST_F(RadioLinkTest, ReportsSilenceAfterASecondAndContinuesToPollSlowly) {
  connect();
  dongle_.is_in_range = [] { return false; };
  static_cast<void>(listen(milliseconds(900)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  static_cast<void>(listen(milliseconds(200)));
  EXPECT_EQ(condition(), LinkCondition::kSilent);
  EXPECT_EQ(link().statistics().silences, 1U);
  EXPECT_FALSE(link().statistics().safelink);
  for (const Duration pause : pauses_in(seconds(10))) EXPECT_EQ(pause, milliseconds(50));
  EXPECT_NEAR(safelink_requests(), 10, 1);
  EXPECT_EQ(link().statistics().silences, 1U);
}

TEST_F(RadioLinkTest, ConnectsAgainAfterASilenceWithoutTheRequestsFromBefore) {
  connect();
  dongle_.is_in_range = [] { return false; };
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  EXPECT_EQ(listen(milliseconds(20)).size(), 1U);
  ASSERT_TRUE(link().send(Bytes{0x5C, 4}).ok());
  static_cast<void>(listen(seconds(2)));
  dongle_.vehicle = FakeRadioVehicle{};  // it was off
  dongle_.is_in_range = [] { return true; };
  ASSERT_TRUE(link().send(Bytes{0x5C, 5}).ok());
  const std::vector<LinkFrame> frames = listen(milliseconds(100));
  EXPECT_EQ(packets_of(frames, LinkDirection::kToVehicle), (std::vector<Bytes>{{0x50, 5}}));
  EXPECT_EQ(dongle_.vehicle.accepted.size(), 1U);
  EXPECT_TRUE(link().statistics().safelink);
  EXPECT_EQ(condition(), LinkCondition::kConnected);
}

TEST_F(RadioLinkTest, DeliversAPacketRepeatedAfterASilenceOnce) {
  connect();
  dongle_.vehicle.waiting = {{0x52, 1}};
  EXPECT_EQ(listen(milliseconds(20)).size(), 1U);
  dongle_.vehicle.last = {0x52, 1};  // and repeats it after the silence
  dongle_.vehicle.down = 1;
  dongle_.is_in_range = [] { return false; };
  static_cast<void>(listen(milliseconds(1100)));
  dongle_.is_in_range = [] { return true; };
  EXPECT_TRUE(listen(milliseconds(100)).empty());
  EXPECT_EQ(link().statistics().duplicates, 1U);
}

TEST_F(RadioLinkTest, PollsWithoutPauseWhileThereIsContentElseSlowly) {
  connect();
  for (const Duration pause : pauses_in(milliseconds(900))) EXPECT_EQ(pause, milliseconds(5));
  static_cast<void>(listen(milliseconds(200)));
  for (const Duration pause : pauses_in(seconds(5))) EXPECT_EQ(pause, milliseconds(10));
  dongle_.packets.clear();
  for (std::uint8_t i = 0; i < 20; ++i) dongle_.vehicle.waiting.push_back({0x00, i});
  EXPECT_EQ(listen(milliseconds(35)).size(), 20U);
  for (std::size_t i = 1; i <= 20; ++i)
    EXPECT_EQ(dongle_.packets[i].at - dongle_.packets[i - 1].at, milliseconds(1));
}

TEST_F(RadioLinkTest, SendsARequestAtOnce) {
  connect();
  static_cast<void>(listen(seconds(2)));
  const HostTime asked_at = clock_.now();
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  const Result<LinkFrame> frame = link().receive(milliseconds(1));
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->at, asked_at);
}

TEST_F(RadioLinkTest, KeepsToTheRateLimitButNeverFallsSilent) {
  address_.rate_limit_hz = 100;
  connect();
  for (std::uint8_t i = 0; i < 50; ++i) dongle_.vehicle.waiting.push_back({0x50, i});
  for (const Duration pause : pauses_in(seconds(1))) EXPECT_EQ(pause, milliseconds(10));
  address_.rate_limit_hz = 1;
  link_.reset();
  static_cast<void>(listen(seconds(5)));
  for (const Duration pause : pauses_in(seconds(5))) EXPECT_EQ(pause, milliseconds(500));
  EXPECT_EQ(link().statistics().silences, 0U);
}

TEST_F(RadioLinkTest, WaitsForAMissingDongle) {
  const std::vector<UsbIdentity> dongles = std::exchange(dongle_.plugged_in, {});
  const HostTime asked_at = clock_.now();
  const Result<LinkFrame> frame = link().receive(milliseconds(730));
  EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
  EXPECT_EQ(clock_.now() - asked_at, milliseconds(730));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  static_cast<void>(listen(seconds(9)));
  EXPECT_NEAR(dongle_.lists, 10, 1) << "once a second";
  dongle_.plugged_in = dongles;
  dongle_.has_news = true;
  static_cast<void>(listen(milliseconds(250)));
  EXPECT_EQ(condition(), LinkCondition::kConnected) << "at once, not after the second";
  EXPECT_EQ(link().statistics().device_losses, 0U);
}

TEST_F(RadioLinkTest, ReportsWhyTheDongleCannotBeOpened) {
  for (const auto& [outcome, wanted] : std::vector<std::pair<UsbOutcome, LinkCondition>>{
           {UsbOutcome::kAccessDenied, LinkCondition::kAccessDenied},
           {UsbOutcome::kBusy, LinkCondition::kDeviceBusy},
           {UsbOutcome::kFault, LinkCondition::kDeviceFault}}) {
    dongle_.opening = {outcome};
    static_cast<void>(listen(milliseconds(1100)));
    EXPECT_EQ(condition(), wanted);
  }
  dongle_.opening.clear();
  static_cast<void>(listen(milliseconds(1200)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
}

TEST_F(RadioLinkTest, ReopensTheDongleAfterItWasUnplugged) {
  connect();
  const std::vector<UsbIdentity> dongles = std::exchange(dongle_.plugged_in, {});
  dongle_.has_news = true;
  static_cast<void>(listen(seconds(3)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  EXPECT_EQ(dongle_.open_devices, 0);
  EXPECT_FALSE(link().statistics().safelink);
  dongle_.requests.clear();
  dongle_.plugged_in = dongles;
  ASSERT_TRUE(link().send(Bytes{0x5C, 3}).ok());
  EXPECT_EQ(listen(milliseconds(1500)).size(), 1U);
  EXPECT_EQ(dongle_.requests.size(), 9U) << "tuned again";
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  EXPECT_TRUE(link().statistics().safelink);
  EXPECT_EQ(link().statistics().device_losses, 1U);
  EXPECT_EQ(link().statistics().silences, 1U) << "the vehicle has deleted its log blocks";
}

TEST_F(RadioLinkTest, WaitsForItsOwnDongleAndLeavesAnotherAlone) {
  UsbIdentity others = dongle_.plugged_in[0];
  others.address = 7;
  others.serial = "0123456789";
  dongle_.plugged_in.push_back(others);
  connect();
  UsbIdentity own = dongle_.plugged_in[0];
  dongle_.plugged_in = {others};
  static_cast<void>(listen(seconds(3)));
  EXPECT_EQ(condition(), LinkCondition::kDeviceMissing);
  own.address = 9;
  dongle_.plugged_in.push_back(own);
  static_cast<void>(listen(milliseconds(1500)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
  EXPECT_EQ(dongle_.opened, (std::vector<std::size_t>{0, 1}));
}

TEST_F(RadioLinkTest, WildcardTakesAnotherDongleInThePlaceOfALostOne) {
  address_.dongle = "*";
  connect();
  dongle_.plugged_in[0].address = 7;
  dongle_.plugged_in[0].serial = "0123456789";
  static_cast<void>(listen(milliseconds(1500)));
  EXPECT_EQ(condition(), LinkCondition::kConnected);
}

TEST_F(RadioLinkTest, ReopensAFaultyDongleBeforeTheVehicleDeletesItsBlocks) {
  for (const auto& [fate, wanted] : {std::pair(Fate::kOverflows, LinkCondition::kDeviceOverflows),
                                     std::pair(Fate::kFails, LinkCondition::kDeviceFault)}) {
    static_cast<void>(listen(seconds(2)));
    dongle_.fates = {fate};
    static_cast<void>(listen(milliseconds(20)));
    EXPECT_EQ(condition(), wanted);
    static_cast<void>(listen(milliseconds(200)));
    EXPECT_EQ(condition(), LinkCondition::kConnected);
  }
  EXPECT_EQ(link().statistics().device_losses, 2U);
  EXPECT_EQ(link().statistics().silences, 0U);
}

TEST_F(RadioLinkTest, ReopensADongleThatNeverAnswers) {
  connect();
  dongle_.fates.assign(10, Fate::kNeverAnswered);
  static_cast<void>(listen(seconds(5)));
  EXPECT_EQ(link().statistics().device_losses, 1U);
  EXPECT_EQ(link().statistics().usb_timeouts, 9U);
  EXPECT_EQ(condition(), LinkCondition::kConnected);
}

TEST_F(RadioLinkTest, ReportsAFaultWhileTheDongleFailsAfterEachOpening) {
  connect();
  dongle_.fates.assign(10'000, Fate::kOutStalls);
  static_cast<void>(listen(seconds(2)));
  for (int i = 0; i < 50; ++i) {
    static_cast<void>(listen(milliseconds(100)));
    EXPECT_EQ(condition(), LinkCondition::kDeviceStalls);
  }
  dongle_.fates.clear();
  dongle_.is_in_range = [] { return false; };
  static_cast<void>(listen(milliseconds(1500)));
  EXPECT_EQ(condition(), LinkCondition::kSilent) << "the dongle works again, no vehicle answers";
}

TEST_F(RadioLinkTest, AllocatesNothingOnceItIsConnected) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  ManualLinkClock clock;
  AckingBus bus(clock);
  RadioLink link(bus, clock, {});
  const Bytes request{0x5C, 3};
  for (int i = 0; i < 10; ++i) static_cast<void>(link.receive(milliseconds(10)));
  const test::AllocationCounter counter;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(link.send(request).ok());
    static_cast<void>(link.receive(milliseconds(10)));
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(link.statistics().packets_received, 40U);
  EXPECT_GT(link.statistics().usb_timeouts, 5U);
}

TEST_F(RadioLinkTest, CountsRetriesOfTheDongle) {
  connect();
  dongle_.raw_status = 0x31;
  const std::uint64_t before = link().statistics().packets_sent;
  static_cast<void>(listen(milliseconds(100)));
  EXPECT_EQ(link().statistics().radio_retries, 3 * (link().statistics().packets_sent - before));
}

}  // namespace
}  // namespace swiftlet
