// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "tests/support/emulated_flight.hpp"

// From the emulated Crazyradio to range samples, in simulated time.

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr Duration kRecovery = seconds(2);
constexpr milliseconds kOldestRange{200};

class EmulatedSamples {
 public:
  explicit EmulatedSamples(std::uint64_t seed = 1, const VehicleModel& model = vehicle_on_radio(),
                           const RadioAddress& address = {})
      : flight(seed, model) {
    LinkInput input;
    input.name = "radio://0/80/2M/E7E7E7E7E7";
    input.clock = {std::shared_ptr<LinkClock>(), &flight.clock};  // the flight's own
    input.link = std::make_unique<RadioLink>(flight.bus, flight.clock, address);
    input.starts_logging = true;
    source = std::make_unique<LinkSampleSource>(std::move(input));
  }

  /// Takes what comes within that time, or until `done`.
  void listen(Duration duration, const std::function<bool()>& done = {}) {
    const HostTime end = flight.clock.now() + duration;
    while (flight.clock.now() < end && !(done && done())) {
      const Result<ReceivedSample> received = source->next();
      if (received) {
        samples.push_back(received->sample);
        sample_at = flight.clock.now();
      } else {
        ASSERT_EQ(received.error().code, ErrorCode::kTimeout) << received.error().message;
      }
    }
  }
  /// Until the first sample comes, which happens before long.
  void begin() {
    listen(seconds(20), [this] { return !samples.empty(); });
    ASSERT_FALSE(samples.empty());
  }
  /// One that was measured after this call: what waited in the radio's queue proves nothing.
  void expect_new_sample_within_two_seconds() {
    const HostTime cause_gone = flight.clock.now();
    const std::size_t received = samples.size();
    const std::size_t queued = flight.receiver.queued_log().size();
    listen(seconds(20), [&] { return samples.size() > received && is_newer_than_queued(queued); });
    ASSERT_TRUE(samples.size() > received && is_newer_than_queued(queued));
    EXPECT_LE(sample_at - cause_gone, kRecovery);
  }
  /// Ten a second from sample `first` on, none missing, none twice.
  void expect_steady(std::size_t first = 0) const {
    for (std::size_t i = first + 1; i < samples.size(); ++i) {
      const Duration step = samples[i].measured_at - samples[i - 1].measured_at;
      ASSERT_GE(step, milliseconds(90)) << "sample " << i;
      ASSERT_LE(step, milliseconds(110)) << "sample " << i;
    }
  }
  /// The samples with which segments begin.
  [[nodiscard]] std::vector<RangeSample> segments() const {
    std::vector<RangeSample> first;
    std::ranges::copy_if(samples, std::back_inserter(first), &RangeSample::starts_segment);
    return first;
  }
  [[nodiscard]] const InputReport& report() const { return source->report(); }
  [[nodiscard]] LinkStatistics statistics() const { return source->live_status()->link; }

  /// Whether the last sample is of log packet `index` or a later one.
  [[nodiscard]] bool is_newer_than_queued(std::size_t index) const {
    const std::vector<SentPacket>& log = flight.receiver.queued_log();
    if (log.size() <= index) return false;
    const auto packed_at = milliseconds(load_little_endian(bytes_of(log[index].bytes), 2, 3));
    return samples.back().measured_at >= DeviceTime(packed_at - kOldestRange);
  }

  EmulatedFlight flight;
  std::unique_ptr<LinkSampleSource> source;
  std::vector<RangeSample> samples;
  HostTime sample_at{};
};

TEST(EmulatedSamplesTest, TenMinutesBringSixThousandWithoutAGap) {
  EmulatedSamples flown;
  flown.begin();
  flown.listen(minutes(10));
  EXPECT_NEAR(static_cast<double>(flown.samples.size()), 6000.0, 5.0);
  flown.expect_steady();
  EXPECT_EQ(flown.report().counters.gaps, 0U);
  EXPECT_EQ(flown.report().counters.duplicates, 0U);
  EXPECT_EQ(flown.report().counters.segments, 1U);
}

class LossySamplesTest : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LossySamplesTest, NoneIsLostOrDoubledWithAFifthOfPacketsAndAcksLost) {
  EmulatedSamples flown(GetParam());
  flown.flight.receiver.losses = {.packet = 0.2, .ack = 0.2, .retries_share_fate = true};
  flown.begin();
  flown.listen(minutes(10));
  EXPECT_NEAR(static_cast<double>(flown.samples.size()), 6000.0, 5.0);
  flown.expect_steady();
  EXPECT_EQ(flown.report().counters.missing_packets, 0U);
  EXPECT_EQ(flown.report().counters.duplicates, 0U);
  EXPECT_EQ(flown.report().counters.segments, 1U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossySamplesTest, testing::Values(1, 2, 3));

TEST_P(LossySamplesTest, WithoutSafelinkAPacketThatIsLostAloneCostsItsOwnSampleOnly) {
  RadioAddress address;
  address.safelink = false;
  EmulatedSamples flown(GetParam(), vehicle_on_radio(), address);
  flown.begin();
  flown.flight.receiver.losses = {.packet = 0.2, .ack = 0.2, .retries_share_fate = true};
  flown.listen(minutes(10));
  const InputCounters& counters = flown.report().counters;
  EXPECT_GT(counters.missing_packets, 1000U);
  // Behind two losses in a row: 0.2 * 0.2 * 0.8 of all.
  EXPECT_LT(static_cast<double>(counters.unpaired), 0.045 * 6000.0);
  EXPECT_GT(flown.samples.size(), 4450U);  // 0.8 * 0.96 of 6000, less four standard deviations
}

TEST(EmulatedSamplesTest, ComeAgainWithinTwoSecondsOfThreeSecondsOfSilence) {
  EmulatedSamples flown;
  flown.begin();
  flown.listen(seconds(10));
  flown.flight.receiver.in_range = false;
  flown.listen(seconds(3));
  flown.flight.receiver.in_range = true;
  flown.expect_new_sample_within_two_seconds();
  const std::size_t first = flown.samples.size() - 1;
  flown.listen(seconds(10));
  flown.expect_steady(first);
  EXPECT_EQ(flown.report().counters.gaps, 1U);
  ASSERT_EQ(flown.segments().size(), 2U);
  EXPECT_TRUE(flown.segments()[1].odometry_ran_on);
  EXPECT_EQ(flown.statistics().silences, 1U);
}

TEST(EmulatedSamplesTest, ComeAgainWithinTwoSecondsOfAReboot) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    EmulatedSamples flown(seed);
    flown.begin();
    flown.listen(seconds(10));
    flown.flight.vehicle.reboot();
    flown.listen(seconds(10), [&] { return flown.flight.vehicle.is_on_air(); });
    flown.expect_new_sample_within_two_seconds();
    const std::size_t first = flown.samples.size() - 1;
    flown.listen(seconds(10));
    flown.expect_steady(first);
    EXPECT_EQ(flown.report().counters.gaps, 1U);
    ASSERT_EQ(flown.segments().size(), 2U);
    EXPECT_FALSE(flown.segments()[1].odometry_ran_on);
    EXPECT_EQ(flown.statistics().silences, 1U);
  }
}

TEST(EmulatedSamplesTest, ComeAgainWithinTwoSecondsOfReplugging) {
  for (const Duration absence : {Duration(milliseconds(400)), Duration(seconds(5))}) {
    EmulatedSamples flown;
    flown.begin();
    flown.listen(seconds(10));
    flown.flight.dongle.unplug();
    flown.listen(absence);
    flown.flight.dongle.plug_in();
    flown.expect_new_sample_within_two_seconds();
    flown.listen(seconds(10));
    EXPECT_EQ(flown.statistics().device_losses, 1U);
    EXPECT_EQ(flown.statistics().condition, LinkCondition::kConnected);
    // What the vehicle sent within a second of absence waits in its queue.
    EXPECT_EQ(flown.report().counters.gaps, absence > seconds(1) ? 1U : 0U);
  }
}

TEST(EmulatedSamplesTest, GoOnAcrossTheWrapOfTheVehiclesClock) {
  VehicleModel model = vehicle_on_radio();
  model.clock_start = milliseconds((1 << 24) - 30'000);
  EmulatedSamples flown(1, model);
  flown.begin();
  flown.listen(minutes(1));
  EXPECT_NEAR(static_cast<double>(flown.samples.size()), 600.0, 5.0);
  flown.expect_steady();
  EXPECT_EQ(flown.report().counters.gaps, 0U);
  EXPECT_EQ(flown.report().counters.segments, 1U);
}

}  // namespace
}  // namespace swiftlet
