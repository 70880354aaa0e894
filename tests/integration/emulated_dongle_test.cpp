// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/libusb_bus.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "tests/support/emulated_flight.hpp"
#include "tests/support/umockdev_dongle.hpp"

// The whole way from the real libusb to range samples in real time, on a Crazyradio that libumockdev mocks up
// with the simulated vehicle behind it. To be run under umockdev-wrapper.

namespace swiftlet {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

// On a machine that may be busy with other things. The two seconds that are promised are held against
// simulated time, in emulated_samples_test.cpp.
constexpr Duration kRecovery = seconds(5);
constexpr Duration kConnecting = seconds(20);

/// Keeps the log data of a session.
class LogKeeper final : public FrameSink {
 public:
  void take(const LinkFrame& frame) noexcept override {
    if (frame.direction == LinkDirection::kFromVehicle && is_on(frame.packet(), kLogDataTopic))
      received.emplace_back(frame.packet().begin() + 1, frame.packet().end());
  }
  std::vector<std::vector<std::uint8_t>> received;  ///< without the header, of which radios overwrite bits
};

/// Vehicle, dongle, and the source of samples that a daemon would make.
class EmulatedDongleTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!UmockdevDongle::is_possible()) GTEST_SKIP() << "not run under umockdev-wrapper";
    vehicle_.emplace(make_simulated_world("office").value(), vehicle_on_radio(), /*seed=*/1);
    receiver_.emplace(*vehicle_, /*seed=*/1);
    dongle_.emplace(*receiver_);
    mock_up_.emplace(*dongle_);
    Result<std::unique_ptr<UsbBus>> bus = LibusbBus::open();
    ASSERT_TRUE(bus.ok()) << bus.error().message;
    bus_ = std::move(*bus);
  }
  void TearDown() override {
    source_.reset();
    bus_.reset();
    mock_up_.reset();
  }

  void connect() {
    LinkInput input;
    input.name = "radio://0/80/2M/E7E7E7E7E7";
    input.clock = std::make_shared<SystemLinkClock>();
    input.usb_bus = bus_;
    input.link = std::make_unique<RadioLink>(*bus_, *input.clock, RadioAddress{});
    input.starts_logging = true;
    input.recording = &keeper_;
    source_ = std::make_unique<LinkSampleSource>(std::move(input));
  }
  /// Samples that come within that time, or until `done`.
  std::vector<RangeSample> listen(Duration duration, const std::function<bool()>& done = {}) {
    std::vector<RangeSample> samples;
    const auto end = Clock::now() + duration;
    while (Clock::now() < end && !(done && done())) {
      const Result<ReceivedSample> received = source_->next();
      if (received) {
        samples.push_back(received->sample);
      } else {
        EXPECT_EQ(received.error().code, ErrorCode::kTimeout) << received.error().message;
      }
    }
    return samples;
  }
  /// Until the next sample, which comes before that.
  void expect_sample_within(Duration limit) {
    const auto begin = Clock::now();
    while (!source_->next()) ASSERT_LT(Clock::now() - begin, limit) << "no sample came";
    EXPECT_LT(Clock::now() - begin, limit);
  }
  [[nodiscard]] LinkStatistics statistics() const { return source_->live_status()->link; }
  void expect_condition(LinkCondition condition, Duration limit) {
    static_cast<void>(listen(limit, [&] { return statistics().condition == condition; }));
    EXPECT_EQ(statistics().condition, condition);
  }

  std::optional<SimulatedVehicle> vehicle_;
  std::optional<EmulatedReceiver> receiver_;
  std::optional<EmulatedCrazyradio> dongle_;
  std::optional<UmockdevDongle> mock_up_;
  std::shared_ptr<UsbBus> bus_;
  LogKeeper keeper_;
  std::unique_ptr<LinkSampleSource> source_;
};

TEST_F(EmulatedDongleTest, IsFoundWithItsTexts) {
  const std::vector<UsbIdentity> found =
      bus_->list(EmulatedCrazyradio::kVendor, EmulatedCrazyradio::kProduct);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].release_bcd, 0x0053);
  EXPECT_EQ(found[0].name, EmulatedCrazyradio::kNameOfPa);
  EXPECT_EQ(found[0].serial, EmulatedCrazyradio::kSerial);
  EXPECT_EQ(found[0].access, UsbOutcome::kDone);
}

TEST_F(EmulatedDongleTest, IsInitialisedInOrderBeforeTheFirstSample) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->with([](EmulatedCrazyradio& dongle) { EXPECT_EQ(dongle.requests(), requests_at_opening()); });
}

TEST_F(EmulatedDongleTest, BringsSixtySecondsOfFlightWithoutASampleLostOrDoubled) {
  connect();
  expect_sample_within(kConnecting);
  const std::vector<RangeSample> samples = listen(seconds(60));
  EXPECT_NEAR(static_cast<double>(samples.size()), 600.0, 5.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Duration step = samples[i].measured_at - samples[i - 1].measured_at;
    EXPECT_GE(step, milliseconds(90)) << "sample " << i;
    EXPECT_LE(step, milliseconds(110)) << "sample " << i;
  }
  EXPECT_EQ(source_->report().counters.gaps, 0U);
  EXPECT_EQ(source_->report().counters.duplicates, 0U);
  EXPECT_EQ(source_->report().counters.segments, 1U);
  std::vector<SentPacket> queued;
  mock_up_->with([&](EmulatedCrazyradio&) { queued = receiver_->queued_log(); });
  ASSERT_LE(keeper_.received.size(), queued.size());
  EXPECT_LE(queued.size() - keeper_.received.size(), 3U);  // still on their way
  for (std::size_t i = 0; i < keeper_.received.size(); ++i)
    ASSERT_TRUE(std::ranges::equal(keeper_.received[i], bytes_of(queued[i].bytes).subspan(1)))
        << "packet " << i;
  EXPECT_EQ(statistics().device_losses, 0U);
  EXPECT_TRUE(statistics().safelink);
}

TEST_F(EmulatedDongleTest, UnpluggedAndReplugedInMidFlightItBringsSamplesAgain) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->unplug();
  expect_condition(LinkCondition::kDeviceMissing, kRecovery);
  static_cast<void>(listen(seconds(2)));
  mock_up_->plug_in();
  expect_sample_within(kRecovery);
  EXPECT_EQ(statistics().device_losses, 1U);
  EXPECT_EQ(statistics().condition, LinkCondition::kConnected);
}

struct Fault {
  std::string name;
  DongleFault fault;
  LinkCondition condition;
};
std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }

class DongleFaultTest : public EmulatedDongleTest, public testing::WithParamInterface<Fault> {};

TEST_P(DongleFaultTest, IsToldAndGotOver) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->with([](EmulatedCrazyradio& dongle) { dongle.standing_fault = GetParam().fault; });
  expect_condition(GetParam().condition, seconds(10));
  mock_up_->with([](EmulatedCrazyradio& dongle) { dongle.standing_fault.reset(); });
  expect_sample_within(kRecovery);
  EXPECT_EQ(statistics().condition, LinkCondition::kConnected);
}

TEST_P(DongleFaultTest, OnceIsGotOverAtOnce) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->with([](EmulatedCrazyradio& dongle) { dongle.fail_next(GetParam().fault); });
  static_cast<void>(listen(milliseconds(100)));
  expect_sample_within(kRecovery);
  EXPECT_EQ(statistics().condition, LinkCondition::kConnected);
}

INSTANTIATE_TEST_SUITE_P(
    All, DongleFaultTest,
    testing::Values(Fault{"StallOut", DongleFault::kStallOut, LinkCondition::kDeviceStalls},
                    Fault{"StallIn", DongleFault::kStallIn, LinkCondition::kDeviceStalls},
                    Fault{"Overflow", DongleFault::kOverflow, LinkCondition::kDeviceOverflows},
                    Fault{"NoAnswer", DongleFault::kNoAnswer, LinkCondition::kDeviceMute}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(EmulatedDongleTest, AnAnswerThatComesLateIsNotTakenForTheNext) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->with([](EmulatedCrazyradio& dongle) {
    dongle.late_by = milliseconds(300);
    dongle.fail_next(DongleFault::kLateAnswer);
  });
  static_cast<void>(listen(seconds(2)));
  EXPECT_GE(statistics().usb_timeouts, 1U);
  EXPECT_EQ(source_->report().counters.missing_packets, 0U);
  EXPECT_EQ(source_->report().counters.duplicates, 0U);
}

TEST_F(EmulatedDongleTest, ReplugedWithoutPermissionItSaysSoUntilThereIs) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->unplug();
  mock_up_->plug_in();
  mock_up_->set_access(false);
  expect_condition(LinkCondition::kAccessDenied, kRecovery);
  mock_up_->set_access(true);
  expect_sample_within(kRecovery);
}

TEST_F(EmulatedDongleTest, TakenByAnotherProgramItSaysSoUntilItIsFree) {
  connect();
  expect_sample_within(kConnecting);
  mock_up_->with([](EmulatedCrazyradio& dongle) { dongle.claimed_by_another = true; });
  mock_up_->unplug();
  mock_up_->plug_in();
  expect_condition(LinkCondition::kDeviceBusy, kRecovery);
  mock_up_->with([](EmulatedCrazyradio& dongle) { dongle.claimed_by_another = false; });
  expect_sample_within(kRecovery);
}

TEST_F(EmulatedDongleTest, NotThereAtTheStartItSaysSoUntilItIsPluggedIn) {
  mock_up_->unplug();
  connect();
  expect_condition(LinkCondition::kDeviceMissing, kRecovery);
  mock_up_->plug_in();
  expect_sample_within(kConnecting);
}

}  // namespace
}  // namespace swiftlet
