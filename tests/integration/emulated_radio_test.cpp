// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "firmware_link/link/crazyradio.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "tests/support/emulated_flight.hpp"
#include "tests/support/log_listener.hpp"

// The radio link on an emulated Crazyradio, minutes of flight in simulated time. What the vehicle's radio
// queued is the truth that what was received is held against.

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr Duration kRecovery = seconds(2);

/// Without the header, of which the radio overwrites the link bits.
Bytes content_of(std::span<const std::uint8_t> packet) { return {packet.begin() + 1, packet.end()}; }

std::vector<Bytes> contents_of(const std::vector<LinkFrame>& frames) {
  std::vector<Bytes> contents;
  for (const LinkFrame& frame : frames) contents.push_back(content_of(frame.packet()));
  return contents;
}

std::vector<Bytes> contents_of(const std::vector<SentPacket>& packets) {
  std::vector<Bytes> contents;
  for (const SentPacket& packet : packets) contents.push_back(content_of(bytes_of(packet.bytes)));
  return contents;
}

std::size_t doubled_in(const std::vector<Bytes>& contents) {
  return contents.size() - std::set(contents.begin(), contents.end()).size();
}

class EmulatedRadio {
 public:
  explicit EmulatedRadio(std::uint64_t seed = 1, const RadioAddress& address = {},
                         const VehicleModel& model = vehicle_on_radio(),
                         DongleModel dongle_model = DongleModel::kPa)
      : flight(seed, model, dongle_model),
        link(flight.bus, flight.clock, address),
        listener(link, flight.clock) {}

  /// Everything that the vehicle had for us was received once and in order, but for what is still on its way.
  void expect_none_lost_or_doubled() const {
    const std::vector<Bytes> sent = contents_of(flight.receiver.queued_log());
    const std::vector<Bytes> received = contents_of(listener.received());
    ASSERT_LE(received.size(), sent.size());
    EXPECT_LE(sent.size() - received.size(), 3U) << "received " << received.size() << " of " << sent.size();
    EXPECT_TRUE(std::equal(received.begin(), received.end(), sent.begin()));
    EXPECT_EQ(flight.receiver.dropped(), 0U);
  }
  void expect_data_within_two_seconds_of(HostTime cause_gone) const {
    const std::optional<HostTime> data = listener.first_after(cause_gone);
    ASSERT_TRUE(data.has_value());
    EXPECT_LE(*data - cause_gone, kRecovery);
    EXPECT_EQ(doubled_in(contents_of(listener.received())), 0U);
  }

  EmulatedFlight flight;
  RadioLink link;
  LogListener listener;
};

TEST(EmulatedRadioTest, InitialisesTheDongleInOrder) {
  EmulatedRadio radio;
  radio.listener.listen(seconds(1));
  EXPECT_EQ(radio.flight.dongle.requests(), requests_at_opening());
}

TEST(EmulatedRadioTest, EndsWhatAnotherProgramLeftACrazyradio2In) {
  EmulatedRadio radio(1, {}, vehicle_on_radio(), DongleModel::k2);
  for (const VendorRequest& request : {VendorRequest{0x24, 1, 0, {}}, VendorRequest{0x30, 0, 0, {100, 100}}})
    ASSERT_EQ(radio.flight.dongle.control_out(request), UsbOutcome::kDone);
  radio.listener.listen(minutes(1));
  EXPECT_GE(radio.listener.received().size(), 580U);
  radio.expect_none_lost_or_doubled();
}

TEST(EmulatedRadioTest, EndsTheModeThatACrazyradioPaWasLeftIn) {
  EmulatedRadio radio;
  ASSERT_EQ(radio.flight.dongle.control_out({0x22, 2, 0, {}}), UsbOutcome::kDone);
  radio.listener.listen(minutes(1));
  EXPECT_GE(radio.listener.received().size(), 580U);
}

TEST(EmulatedRadioTest, TellsWhatACrazyradio2DoesNotHave) {
  RadioAddress address;
  address.rate = RadioRate::k250Kbps;
  EmulatedRadio radio(1, address, vehicle_on_radio(), DongleModel::k2);
  radio.listener.listen(seconds(5));
  EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kDeviceUnsuited);
  EXPECT_EQ(radio.flight.dongle.packets_sent(), 0U);
}

TEST(EmulatedRadioTest, HearsTenMinutesAtTenHertzWithoutALoss) {
  EmulatedRadio radio;
  radio.listener.listen(minutes(10));
  EXPECT_GE(radio.listener.received().size(), 5980U);
  radio.expect_none_lost_or_doubled();
  EXPECT_TRUE(radio.link.statistics().safelink);
  EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kConnected);
}

class LossyRadioTest : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LossyRadioTest, LosesAndDoublesNothingWithAFifthOfAllPacketsAndAcksLost) {
  EmulatedRadio radio(GetParam());
  radio.flight.receiver.losses = {.packet = 0.2, .ack = 0.2};
  radio.listener.listen(minutes(10));
  EXPECT_GE(radio.listener.received().size(), 5980U);
  radio.expect_none_lost_or_doubled();
}

TEST_P(LossyRadioTest, LosesAndDoublesNothingWithAFifthOfAllExchangesFailing) {
  EmulatedRadio radio(GetParam());
  radio.flight.receiver.losses = {.packet = 0.2, .ack = 0.2, .retries_share_fate = true};
  radio.listener.listen(minutes(10));
  EXPECT_GE(radio.listener.received().size(), 5980U);
  radio.expect_none_lost_or_doubled();
  const LinkStatistics statistics = radio.link.statistics();
  EXPECT_NEAR(static_cast<double>(statistics.packets_acked) / static_cast<double>(statistics.packets_sent),
              0.64, 0.02);
}

TEST_P(LossyRadioTest, CopesWithOldFirmwareThatAnswersEverySecondSafelinkRequestOnly) {
  EmulatedRadio radio(GetParam());
  radio.flight.receiver.old_firmware = true;
  radio.flight.receiver.losses = {.packet = 0.2, .ack = 0.2, .retries_share_fate = true};
  radio.listener.listen(minutes(2));
  EXPECT_TRUE(radio.link.statistics().safelink);
  radio.expect_none_lost_or_doubled();
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossyRadioTest, testing::Values(1, 2, 3, 4, 5));

TEST(EmulatedRadioTest, ReceivesEverythingWithoutSafelinkAfterAProgramThatUsedIt) {
  EmulatedFlight flight(1);
  {
    RadioLink with_safelink(flight.bus, flight.clock, {});
    LogListener(with_safelink, flight.clock).listen(seconds(5));
    ASSERT_TRUE(flight.receiver.safelink());
  }
  RadioAddress address;
  address.safelink = false;
  RadioLink without(flight.bus, flight.clock, address);
  LogListener listener(without, flight.clock);
  listener.listen(seconds(10));
  EXPECT_FALSE(flight.receiver.safelink());
  EXPECT_GE(listener.received().size(), 95U);
}

TEST(EmulatedRadioTest, CountsLossesHonestlyWithoutSafelink) {
  RadioAddress address;
  address.safelink = false;
  EmulatedRadio radio(7, address);
  radio.flight.receiver.losses = {.packet = 0.2, .ack = 0.2, .retries_share_fate = true};
  radio.listener.listen(minutes(5));
  const std::vector<Bytes> sent = contents_of(radio.flight.receiver.queued_log());
  const std::vector<Bytes> received = contents_of(radio.listener.received());
  EXPECT_EQ(doubled_in(received), 0U);
  // A lost ACK takes its payload with it.
  EXPECT_NEAR(static_cast<double>(received.size()) / static_cast<double>(sent.size()), 0.8, 0.05);
  const LinkStatistics statistics = radio.link.statistics();
  EXPECT_FALSE(statistics.safelink);
  EXPECT_EQ(statistics.packets_sent, radio.flight.dongle.packets_sent());
  EXPECT_EQ(statistics.packets_received, received.size() + radio.listener.replies());
}

class LateAnswerTest : public testing::TestWithParam<int> {};

TEST_P(LateAnswerTest, NeverTakesALateAnswerForTheNextPackets) {
  EmulatedRadio radio;
  radio.flight.dongle.late_by = milliseconds(GetParam());
  radio.listener.listen(seconds(5));
  for (int i = 0; i < 40; ++i) {
    radio.flight.dongle.fail_next(i % 2 == 0 ? DongleFault::kLateAnswer : DongleFault::kNoAnswer);
    radio.listener.listen(milliseconds(1500));
  }
  radio.listener.listen(seconds(2));
  EXPECT_GE(radio.link.statistics().usb_timeouts, 40U);
  EXPECT_EQ(radio.link.statistics().device_losses, 0U);
  radio.expect_none_lost_or_doubled();
  // One answer to one packet, and nothing left over.
  EXPECT_FALSE(radio.flight.dongle.answer_in().has_value());
}

TEST_P(LateAnswerTest, IsFollowedByEachPacketsOwnAnswer) {
  EmulatedFlight flight(1);
  flight.dongle.late_by = milliseconds(GetParam());
  std::variant<Crazyradio, UsbOutcome> opened = Crazyradio::open(flight.bus, RadioAddress{});
  ASSERT_EQ(opened.index(), 0U);
  Crazyradio& radio = std::get<Crazyradio>(opened);
  // The vehicle echoes each packet in the acknowledgement of the next.
  const auto exchange = [&](std::uint8_t number) { return radio.exchange(Bytes{0xFC, number}); };
  EXPECT_TRUE(exchange(0).acknowledged);
  flight.dongle.fail_next(DongleFault::kLateAnswer);
  EXPECT_EQ(exchange(1).outcome, UsbOutcome::kTimeout);
  int received = 0;
  for (std::uint8_t number = 2; number < 20; ++number) {
    const RadioAnswer answer = exchange(number);
    if (answer.outcome == UsbOutcome::kTimeout) continue;
    ++received;
    const PacketBytes& before = flight.receiver.uplink().end()[-2];
    EXPECT_TRUE(std::ranges::equal(answer.payload, before)) << "packet " << int{number};
  }
  EXPECT_GE(received, 15);
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, LateAnswerTest, testing::Values(255, 300, 400, 700));

TEST(EmulatedRadioTest, GoesOnAfterStallsWithoutALoss) {
  for (const DongleFault fault : {DongleFault::kStallOut, DongleFault::kStallIn}) {
    EmulatedRadio radio;
    radio.listener.listen(seconds(5));
    for (int i = 0; i < 20; ++i) {
      radio.flight.dongle.fail_next(fault);
      radio.listener.listen(seconds(3));
    }
    radio.expect_none_lost_or_doubled();
    EXPECT_EQ(radio.link.statistics().device_losses, 0U);
    EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kConnected);
  }
}

TEST(EmulatedRadioTest, GoesOnAfterOverflowsWithADongleOpenedAnew) {
  EmulatedRadio radio;
  radio.listener.listen(seconds(5));
  for (int i = 0; i < 20; ++i) {
    radio.flight.dongle.fail_next(DongleFault::kOverflow);
    const HostTime before = radio.flight.clock.now();
    radio.listener.listen(seconds(3));
    radio.expect_data_within_two_seconds_of(before);
  }
  EXPECT_EQ(radio.link.statistics().device_losses, 20U);
  EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kConnected);
}

struct StandingFault {
  std::string name;
  void (*begin)(EmulatedCrazyradio&);
  void (*end)(EmulatedCrazyradio&);
  LinkCondition condition;
};
std::ostream& operator<<(std::ostream& out, const StandingFault& fault) { return out << fault.name; }

void stop_fault(EmulatedCrazyradio& dongle) { dongle.standing_fault.reset(); }
template <DongleFault kFault>
void start_fault(EmulatedCrazyradio& dongle) {
  dongle.standing_fault = kFault;
}

class StandingFaultTest : public testing::TestWithParam<StandingFault> {};

TEST_P(StandingFaultTest, IsToldAndGotOverWithinTwoSeconds) {
  EmulatedRadio radio;
  const StandingFault& fault = GetParam();
  radio.listener.listen(seconds(5));
  fault.begin(radio.flight.dongle);
  radio.listener.listen(seconds(4));
  for (int i = 0; i < 10; ++i) {
    radio.listener.listen(milliseconds(730));
    EXPECT_EQ(radio.link.statistics().condition, fault.condition);
  }
  fault.end(radio.flight.dongle);
  const HostTime gone = radio.flight.clock.now();
  radio.listener.listen(seconds(10));
  radio.expect_data_within_two_seconds_of(gone);
  EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kConnected);
}

// A program that has the dongle, or rights that are gone, are met when it is opened.
void take_away(EmulatedCrazyradio& dongle) {
  dongle.unplug();
  dongle.plug_in();
}

INSTANTIATE_TEST_SUITE_P(
    All, StandingFaultTest,
    testing::Values(StandingFault{"Missing", [](EmulatedCrazyradio& dongle) { dongle.unplug(); },
                                  [](EmulatedCrazyradio& dongle) { dongle.plug_in(); },
                                  LinkCondition::kDeviceMissing},
                    StandingFault{"AccessDenied",
                                  [](EmulatedCrazyradio& dongle) {
                                    take_away(dongle);
                                    dongle.denies_access = true;
                                  },
                                  [](EmulatedCrazyradio& dongle) { dongle.denies_access = false; },
                                  LinkCondition::kAccessDenied},
                    StandingFault{"Busy",
                                  [](EmulatedCrazyradio& dongle) {
                                    take_away(dongle);
                                    dongle.claimed_by_another = true;
                                  },
                                  [](EmulatedCrazyradio& dongle) { dongle.claimed_by_another = false; },
                                  LinkCondition::kDeviceBusy},
                    StandingFault{"StallOut", start_fault<DongleFault::kStallOut>, stop_fault,
                                  LinkCondition::kDeviceStalls},
                    StandingFault{"StallIn", start_fault<DongleFault::kStallIn>, stop_fault,
                                  LinkCondition::kDeviceStalls},
                    StandingFault{"Overflow", start_fault<DongleFault::kOverflow>, stop_fault,
                                  LinkCondition::kDeviceOverflows},
                    StandingFault{"NoAnswer", start_fault<DongleFault::kNoAnswer>, stop_fault,
                                  LinkCondition::kDeviceMute}),
    [](const auto& instance) { return instance.param.name; });

TEST(EmulatedRadioTest, HearsTheVehicleAgainWithinTwoSecondsOfThreeSecondsOfSilence) {
  EmulatedRadio radio;
  radio.listener.listen(seconds(10));
  radio.flight.receiver.in_range = false;
  radio.listener.listen(seconds(3));
  EXPECT_EQ(radio.link.statistics().condition, LinkCondition::kSilent);
  radio.flight.receiver.in_range = true;
  const HostTime gone = radio.flight.clock.now();
  radio.listener.listen(seconds(10));
  radio.expect_data_within_two_seconds_of(gone);
  EXPECT_EQ(radio.link.statistics().silences, 1U);
  EXPECT_EQ(radio.link.statistics().device_losses, 0U);
}

TEST(EmulatedRadioTest, HearsARebootedVehicleAgainWithinTwoSecondsAndAllOfIt) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    EmulatedRadio radio(seed);
    radio.listener.listen(seconds(10));
    radio.flight.vehicle.reboot();
    while (!radio.flight.vehicle.is_on_air()) radio.listener.listen(milliseconds(20));
    const HostTime gone = radio.flight.clock.now();
    radio.listener.listen(seconds(20));
    radio.expect_data_within_two_seconds_of(gone);
    EXPECT_TRUE(radio.link.statistics().safelink);
    EXPECT_EQ(radio.link.statistics().silences, 1U);
    EXPECT_TRUE(std::ranges::equal(contents_of(radio.listener.received()),
                                   contents_of(radio.flight.receiver.queued_log())));
  }
}

TEST(EmulatedRadioTest, ADongleReplugedInMidFlightIsSetUpAnew) {
  EmulatedRadio radio;
  radio.listener.listen(seconds(10));
  radio.flight.dongle.forget_requests();
  radio.flight.dongle.unplug();
  radio.listener.listen(milliseconds(700));  // the vehicle keeps its log blocks
  radio.flight.dongle.plug_in();
  const HostTime gone = radio.flight.clock.now();
  radio.listener.listen(seconds(10));
  radio.expect_data_within_two_seconds_of(gone);
  EXPECT_EQ(radio.link.statistics().device_losses, 1U);
  EXPECT_EQ(radio.flight.dongle.requests().size(), 9U);
}

TEST(EmulatedRadioTest, HearsAllAcrossTheWrapOfTheVehiclesClock) {
  VehicleModel model = vehicle_on_radio();
  model.clock_start = milliseconds((1 << 24) - 30'000);
  EmulatedRadio radio(1, {}, model);
  radio.listener.listen(minutes(1));
  radio.expect_none_lost_or_doubled();
  EXPECT_LT(radio.flight.receiver.queued_log().back().bytes[4], 0x01);
}

}  // namespace
}  // namespace swiftlet
