// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// The daemon's own threads over whole runs: once started up, "radio" and "frontend" neither take memory from
// the heap nor give any back. Start-up ends with the first sample, for "radio" on a vehicle that answers when
// it has been asked about itself, too.

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "daemon/daemon.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/link/udp_link.hpp"
#include "firmware_link/simulation/link.hpp"
#include "firmware_link/simulation/udp_server.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"
#include "tests/support/heap_watch.hpp"
#include "tests/support/recording_publisher.hpp"
#include "tests/support/reference_data.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kAsked = 100;  // samples: by then the vehicle has been identified

/// Through the daemon as fast as it goes. `radio` is the span that the source's own parts may know of; it
/// begins at the sample of the number `from`.
void expect_no_heap_calls(SampleSource& source, test::HeapSpan& radio, std::size_t from,
                          std::size_t min_samples) {
  test::WatchedSource watched(source, radio, from);
  test::WatchfulClock clock("frontend");
  RecordingPublisher publisher;
  Daemon daemon(Configuration{}, watched, clock, InputPolicy{}, publisher);
  const Status outcome = daemon.run(std::stop_token{});
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  EXPECT_GE(watched.samples(), min_samples);
  EXPECT_EQ(daemon.pipeline().frontend().counters().samples, watched.samples());
  EXPECT_EQ(radio.calls().taken, 0U);
  EXPECT_EQ(radio.calls().given_back, 0U);
  EXPECT_EQ(clock.span().calls().taken, 0U);
  EXPECT_EQ(clock.span().calls().given_back, 0U);
}

class WholeRun : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  }
};

struct KnownInput {
  const char* name;
  const char* file;
  std::size_t samples;
};

class RecordedRun : public WholeRun, public testing::WithParamInterface<KnownInput> {};

TEST_P(RecordedRun, TakesNothingFromTheHeapOnRadioAndFrontend) {
  const std::string path = reference_file(GetParam().file);
  SWIFTLET_REQUIRE_REFERENCE(path);
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source(path, {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  test::HeapSpan radio;
  expect_no_heap_calls(**source, radio, 1, GetParam().samples);
}

INSTANTIATE_TEST_SUITE_P(Reference, RecordedRun,
                         testing::Values(KnownInput{"olsson", "flights/olsson.pcap", 1000},
                                         KnownInput{"rice", "flights/rice.pcap", 1000},
                                         KnownInput{"intel", "radish/intel.clf.gz", 10'000}),
                         [](const auto& input) { return std::string(input.param.name); });

/// The simulated vehicle lives in the radio thread and may allocate; what receives from it may not.
class UncountedVehicle final : public Link {
 public:
  UncountedVehicle(std::unique_ptr<SimulatedLink> vehicle, test::HeapSpan& span)
      : vehicle_(std::move(vehicle)), span_(span) {}
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override {
    return span_.without([&] { return vehicle_->receive(timeout); });
  }
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override {
    return span_.without([&] { return vehicle_->send(packet); });
  }

 private:
  std::unique_ptr<SimulatedLink> vehicle_;
  test::HeapSpan& span_;
};

TEST_F(WholeRun, OfASimulatedFlightTakesNothingFromTheHeapOnRadioAndFrontend) {
  Result<std::unique_ptr<SimulatedLink>> vehicle = SimulatedLink::open("office", 1);
  ASSERT_TRUE(vehicle.ok());
  test::HeapSpan radio;
  LinkInput input;
  input.name = "sim://office";
  input.starts_logging = true;
  input.truth =
      KnownTruth{[simulated = vehicle->get()](DeviceTime at) { return simulated->T_world_body(at); },
                 PoseFile::open().value()};
  input.link = std::make_unique<UncountedVehicle>(std::move(vehicle).value(), radio);
  LinkSampleSource source(std::move(input));
  expect_no_heap_calls(source, radio, kAsked, 1000);
  EXPECT_GE(source.ground_truth().size(), 1000U);
}

/// A UDP link to a simulated vehicle on the loopback, both in simulated time: it passes while the link has
/// received nothing. Over when the vehicle has landed.
class SimulatedUdpFlight final : public Link {
 public:
  SimulatedUdpFlight(std::shared_ptr<ManualLinkClock> clock, test::HeapSpan& span)
      : clock_(std::move(clock)), span_(span) {
    const std::string address = server_->address();
    const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
    link_ = std::move(UdpLink::open("127.0.0.1", port, *clock_)).value();
  }
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override {
    for (const HostTime end = clock_->now() + timeout; clock_->now() < end; clock_->sleep_for(kTick)) {
      if (vehicle_.is_finished()) return Error{ErrorCode::kEndOfRecording, "landed"};
      Result<LinkFrame> frame = link_->receive(Duration::zero());
      if (frame) return frame;
      span_.without([&] { return server_->serve(), true; });
    }
    return Error{ErrorCode::kTimeout, "silent"};
  }
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override { return link_->send(packet); }
  [[nodiscard]] LinkStatistics statistics() const override { return link_->statistics(); }

 private:
  static constexpr Duration kTick = std::chrono::milliseconds(5);

  std::shared_ptr<ManualLinkClock> clock_;
  test::HeapSpan& span_;
  SimulatedVehicle vehicle_{make_simulated_world("office").value(), VehicleModel{}, 1};
  std::unique_ptr<SimulatedUdpServer> server_ =
      std::move(SimulatedUdpServer::open("127.0.0.1", 0, vehicle_, *clock_, 1)).value();
  std::unique_ptr<UdpLink> link_;
};

TEST_F(WholeRun, OfALiveFlightOverUdpTakesNothingFromTheHeapOnRadioAndFrontend) {
  test::HeapSpan radio;
  LinkInput input;
  const auto clock = std::make_shared<ManualLinkClock>();
  input.name = "udp://127.0.0.1";
  input.starts_logging = true;
  input.clock = clock;
  input.link = std::make_unique<SimulatedUdpFlight>(clock, radio);
  LinkSampleSource source(std::move(input));
  expect_no_heap_calls(source, radio, kAsked, 1000);
  EXPECT_EQ(source.report().counters.segments, 1U);
}

}  // namespace
}  // namespace swiftlet
