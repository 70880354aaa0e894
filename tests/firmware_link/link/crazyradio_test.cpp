// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/crazyradio.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "tests/firmware_link/fake_dongle.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

constexpr std::array<std::uint8_t, 1> kPoll{0xFF};

class CrazyradioTest : public testing::Test {
 protected:
  Crazyradio open() {
    std::variant<Crazyradio, UsbOutcome> opened = Crazyradio::open(dongle_, address_);
    EXPECT_EQ(opened.index(), 0U);
    return std::get<Crazyradio>(std::move(opened));
  }
  UsbOutcome failure() {
    const std::variant<Crazyradio, UsbOutcome> opened = Crazyradio::open(dongle_, address_);
    return opened.index() == 1 ? std::get<UsbOutcome>(opened) : UsbOutcome::kDone;
  }
  void plug_in(std::string serial) {
    UsbIdentity another = dongle_.plugged_in.front();
    another.address = static_cast<std::uint8_t>(dongle_.plugged_in.size());
    another.serial = std::move(serial);
    dongle_.plugged_in.push_back(another);
  }
  static Bytes payload_of(const RadioAnswer& answer) {
    return {answer.payload.begin(), answer.payload.end()};
  }

  ManualLinkClock clock_;
  FakeDongle dongle_{clock_};
  RadioAddress address_;
};

TEST_F(CrazyradioTest, IsResetAndTunedInOrder) {
  address_.channel = 90;
  address_.rate = RadioRate::k1Mbps;
  address_.address = {0xE7, 0xE7, 0xE7, 0xE7, 0x01};
  static_cast<void>(open());
  const std::vector<FakeDongle::Request> wanted{{0x22, 0, {}},
                                                {0x03, 1, {}},
                                                {0x01, 90, {}},
                                                {0x20, 0, {}},
                                                {0x02, 0, {0xE7, 0xE7, 0xE7, 0xE7, 0x01}},
                                                {0x04, 3, {}},
                                                {0x06, 3, {}},
                                                {0x05, 0xA0, {}},
                                                {0x10, 1, {}}};
  EXPECT_EQ(dongle_.requests, wanted);
  EXPECT_EQ(dongle_.resets, 1);
}

TEST_F(CrazyradioTest, EndsTheModesOfACrazyradio2ThatSurviveAReset) {
  dongle_.plugged_in[0].release_bcd = 0x0504;
  static_cast<void>(open());
  ASSERT_GT(dongle_.requests.size(), 2U);
  EXPECT_EQ(dongle_.requests[0], (FakeDongle::Request{0x24, 0, {}}));
  EXPECT_EQ(dongle_.requests[1], (FakeDongle::Request{0x30, 0, {0, 0}}));
  for (const FakeDongle::Request& request : dongle_.requests) EXPECT_NE(request.number, 0x22);
}

TEST_F(CrazyradioTest, NeverSendsACrazyradioPaWhatItTakesForARegister) {
  for (const int release : {0x0053, 0x9955}) {
    dongle_.plugged_in[0].release_bcd = static_cast<std::uint16_t>(release);
    static_cast<void>(open());
  }
  for (const FakeDongle::Request& request : dongle_.requests) EXPECT_LT(request.number, 0x23);
}

TEST_F(CrazyradioTest, RefusesARateOrChannelThatACrazyradio2DoesNotHave) {
  dongle_.plugged_in[0].release_bcd = 0x0504;
  address_.channel = 101;
  EXPECT_EQ(failure(), UsbOutcome::kUnsuited);
  address_.channel = 100;
  EXPECT_EQ(failure(), UsbOutcome::kDone);
  address_.rate = RadioRate::k250Kbps;
  EXPECT_EQ(failure(), UsbOutcome::kUnsuited);
  plug_in("A1B2C3D4E6");
  dongle_.plugged_in[1].release_bcd = 0x0053;
  address_.dongle = "*";
  EXPECT_EQ(failure(), UsbOutcome::kDone) << "another one has it";
}

TEST_F(CrazyradioTest, SendsSettingsOnlyWhenTheyChange) {
  Crazyradio radio = open();
  dongle_.requests.clear();
  EXPECT_EQ(radio.set_channel(80), UsbOutcome::kDone);
  EXPECT_EQ(radio.set_rate(RadioRate::k2Mbps), UsbOutcome::kDone);
  EXPECT_EQ(radio.set_address(address_.address), UsbOutcome::kDone);
  EXPECT_EQ(radio.set_retries(3), UsbOutcome::kDone);
  EXPECT_TRUE(dongle_.requests.empty());
  EXPECT_EQ(radio.set_channel(81), UsbOutcome::kDone);
  EXPECT_EQ(radio.set_retries(1), UsbOutcome::kDone);
  const std::vector<FakeDongle::Request> wanted{{0x01, 81, {}}, {0x06, 1, {}}};
  EXPECT_EQ(dongle_.requests, wanted);
}

TEST_F(CrazyradioTest, RepeatsASettingThatFailed) {
  Crazyradio radio = open();
  dongle_.request_outcome = UsbOutcome::kTimeout;
  EXPECT_EQ(radio.set_channel(81), UsbOutcome::kTimeout);
  dongle_.request_outcome = UsbOutcome::kDone;
  dongle_.requests.clear();
  EXPECT_EQ(radio.set_channel(81), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.requests.size(), 1U);
}

TEST_F(CrazyradioTest, IsReopenedWhenItIsAnotherDeviceAfterTheReset) {
  dongle_.reset_outcome = UsbOutcome::kNoDevice;
  Crazyradio radio = open();
  EXPECT_EQ(dongle_.opened, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(dongle_.open_devices, 1);
  EXPECT_TRUE(radio.exchange(kPoll).acknowledged);
}

TEST_F(CrazyradioTest, ReportsWhyItCannotBeOpened) {
  for (const UsbOutcome outcome : {UsbOutcome::kAccessDenied, UsbOutcome::kBusy, UsbOutcome::kFault}) {
    dongle_.opening = {outcome};
    EXPECT_EQ(failure(), outcome);
  }
  dongle_.opening.clear();
  dongle_.request_outcome = UsbOutcome::kStall;
  EXPECT_EQ(failure(), UsbOutcome::kStall);
  dongle_.request_outcome = UsbOutcome::kDone;
  dongle_.reset_outcome = UsbOutcome::kFault;
  EXPECT_EQ(failure(), UsbOutcome::kFault);
  dongle_.plugged_in.clear();
  EXPECT_EQ(failure(), UsbOutcome::kNoDevice);
  EXPECT_EQ(dongle_.open_devices, 0);
}

TEST_F(CrazyradioTest, RequiresFirmwareThatKnowsTheRequests) {
  dongle_.plugged_in[0].release_bcd = 0x0039;
  EXPECT_EQ(failure(), UsbOutcome::kFault);
  for (const int release : {0x0040, 0x0053, 0x0504, 0x9955}) {
    dongle_.plugged_in[0].release_bcd = static_cast<std::uint16_t>(release);
    EXPECT_EQ(failure(), UsbOutcome::kDone) << release;
  }
}

TEST_F(CrazyradioTest, IsFoundByIndexSerialNumberOrWildcard) {
  plug_in("0123456789");
  plug_in("00112233AABBCCDD");
  for (const auto& [name, index] : std::vector<std::pair<std::string, std::size_t>>{
           {"0", 0}, {"2", 2}, {"0123456789", 1}, {"00112233aabbccdd", 2}, {"*", 0}}) {
    dongle_.opened.clear();
    address_.dongle = name;
    EXPECT_EQ(failure(), UsbOutcome::kDone) << name;
    EXPECT_EQ(dongle_.opened, std::vector<std::size_t>{index}) << name;
  }
  for (const char* name : {"3", "9999999999", "A1B2"}) {
    address_.dongle = name;
    EXPECT_EQ(failure(), UsbOutcome::kNoDevice) << name;
  }
}

TEST_F(CrazyradioTest, WildcardSelectsTheFirstThatIsFree) {
  plug_in("0123456789");
  address_.dongle = "*";
  dongle_.opening = {UsbOutcome::kBusy};
  EXPECT_EQ(failure(), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.opened, std::vector<std::size_t>{1});
  dongle_.opening = {UsbOutcome::kBusy, UsbOutcome::kAccessDenied};
  EXPECT_EQ(failure(), UsbOutcome::kBusy);
}

TEST_F(CrazyradioTest, WildcardGoesPastADongleThatOpensAndFails) {
  plug_in("0123456789");
  address_.dongle = "*";
  dongle_.faulty = 0;
  dongle_.reset_outcome = UsbOutcome::kFault;
  EXPECT_EQ(failure(), UsbOutcome::kDone);
  dongle_.reset_outcome = UsbOutcome::kDone;
  dongle_.request_outcome = UsbOutcome::kTimeout;
  EXPECT_EQ(failure(), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.opened, (std::vector<std::size_t>{0, 1, 0, 1}));
  dongle_.opening = {UsbOutcome::kDone, UsbOutcome::kBusy};
  EXPECT_EQ(failure(), UsbOutcome::kTimeout) << "of the first";
  EXPECT_EQ(dongle_.open_devices, 0);
}

TEST_F(CrazyradioTest, IsNotMissingIfItsSerialNumberMayNotBeRead) {
  dongle_.plugged_in[0].serial.clear();
  dongle_.plugged_in[0].access = UsbOutcome::kAccessDenied;
  address_.dongle = "A1B2C3D4E5";
  EXPECT_EQ(failure(), UsbOutcome::kAccessDenied);
  address_.dongle = "1";
  EXPECT_EQ(failure(), UsbOutcome::kNoDevice);
}

TEST_F(CrazyradioTest, IsNotOpenedIfItMayNotBeTheRequestedOne) {
  dongle_.plugged_in[0].serial.clear();
  dongle_.plugged_in[0].access = UsbOutcome::kAccessDenied;  // as it was listed; opening it would work by now
  plug_in("0123456789");
  dongle_.plugged_in[1].access = UsbOutcome::kDone;
  address_.dongle = "A1B2C3D4E5";
  EXPECT_EQ(failure(), UsbOutcome::kAccessDenied);
  EXPECT_TRUE(dongle_.opened.empty());
  address_.dongle = "0123456789";
  EXPECT_EQ(failure(), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.opened, std::vector<std::size_t>{1});
}

TEST_F(CrazyradioTest, ReportsTheOutcomeOfAPacket) {
  Crazyradio radio = open();
  dongle_.vehicle.waiting.push_back({0x52, 1, 0x8E, 0x11, 0});
  dongle_.raw_status = 0x23;
  const RadioAnswer received = radio.exchange(kPoll);
  EXPECT_EQ(received.outcome, UsbOutcome::kDone);
  EXPECT_TRUE(received.acknowledged);
  EXPECT_EQ(received.retries, 2);
  EXPECT_EQ(payload_of(received), (Bytes{0x52, 1, 0x8E, 0x11, 0}));

  dongle_.fates = {Fate::kPacketLost};
  const RadioAnswer lost = radio.exchange(kPoll);
  EXPECT_EQ(lost.outcome, UsbOutcome::kDone);
  EXPECT_FALSE(lost.acknowledged);
  EXPECT_TRUE(lost.payload.empty());

  dongle_.raw_status = 0xF1;
  dongle_.vehicle.waiting.push_back(Bytes(32, 0x5C));
  const RadioAnswer full = radio.exchange(kPoll);
  EXPECT_EQ(full.retries, 15);
  EXPECT_EQ(full.payload.size(), 32U);
}

TEST_F(CrazyradioTest, NeverTakesALateAnswerForTheNextOne) {
  Crazyradio radio = open();
  dongle_.vehicle.waiting = {{0x50, 1}, {0x50, 2}, {0x50, 3}};
  dongle_.fates = {Fate::kAnsweredLate};
  const HostTime asked_at = clock_.now();
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kTimeout);
  EXPECT_GE(clock_.now() - asked_at, milliseconds(100));
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 2}));
  const HostTime back_at = clock_.now();
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 3}));
  EXPECT_EQ(clock_.now() - back_at, milliseconds(1)) << "all is as usual again";
}

TEST_F(CrazyradioTest, RecognisesALateAnswerByTheNextOneBehindIt) {
  Crazyradio radio = open();
  dongle_.vehicle.waiting = {{0x50, 1}, {0x50, 2}, {0x50, 3}};
  dongle_.fates = {Fate::kAnsweredLate};
  dongle_.lateness = 2;  // not even while the dongle is drained, but in the midst of the next exchange
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kTimeout);
  const RadioAnswer doubtful = radio.exchange(kPoll);
  EXPECT_EQ(doubtful.outcome, UsbOutcome::kTimeout);
  EXPECT_FALSE(doubtful.acknowledged);
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 3}));
}

TEST_F(CrazyradioTest, ContinuesAfterAMissingAnswer) {
  Crazyradio radio = open();
  dongle_.fates = {Fate::kNeverAnswered, Fate::kPacketLost};
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kTimeout);
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kDone);
  dongle_.vehicle.waiting = {{0x50, 4}};
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 4}));
}

TEST_F(CrazyradioTest, DiscardsAnswersToAnEarlierProgram) {
  dongle_.answers = {{0x01, 0xF3}, {0x01, 0x50, 9}};
  Crazyradio radio = open();
  dongle_.vehicle.waiting = {{0x50, 1}};
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 1}));
  for (int i = 0; i < 100; ++i) dongle_.answers.push_back({0x00});
  EXPECT_EQ(failure(), UsbOutcome::kFault) << "it never stops talking";
}

TEST_F(CrazyradioTest, ContinuesAfterAStall) {
  Crazyradio radio = open();
  dongle_.fates = {Fate::kOutStalls, Fate::kInStalls};
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kStall);
  EXPECT_EQ(dongle_.cleared, Bytes{0x01});
  dongle_.vehicle.waiting = {{0x50, 1}, {0x50, 2}};
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kStall);
  EXPECT_EQ(dongle_.cleared, (Bytes{0x01, 0x81}));
  EXPECT_EQ(payload_of(radio.exchange(kPoll)), (Bytes{0x50, 2}));
}

TEST_F(CrazyradioTest, ReportsErrorsThatItCannotRecoverFrom) {
  Crazyradio radio = open();
  dongle_.fates = {Fate::kOverflows, Fate::kFails};
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kOverflow);
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kFault);
  dongle_.plugged_in.clear();
  EXPECT_EQ(radio.exchange(kPoll).outcome, UsbOutcome::kNoDevice);
}

}  // namespace
}  // namespace swiftlet
