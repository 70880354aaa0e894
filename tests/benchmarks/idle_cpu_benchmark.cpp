// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// How much of a core the radio thread takes while the vehicle is there and has nothing to say.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/check.hpp"
#include "daemon/workers/radio_worker.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "firmware_link/link/udp_link.hpp"
#include "tests/firmware_link/fake_dongle.hpp"
#include "tests/firmware_link/udp_peer.hpp"
#include "tests/support/thread_cpu_time.hpp"

namespace swiftlet {
namespace {

constexpr Duration kWatched = std::chrono::seconds(10);

/// Answers every datagram with a null packet.
class QuietVehicle {
 public:
  ~QuietVehicle() {
    stop_ = true;
    thread_.join();
  }
  [[nodiscard]] std::uint16_t port() const { return peer_.port(); }

 private:
  void run() {
    constexpr std::array<std::uint8_t, 1> kNullPacket{0xF3};
    while (!stop_)
      if (peer_.receive(50)) peer_.send(kNullPacket);
  }

  UdpPeer peer_;
  std::atomic<bool> stop_{false};
  std::thread thread_{&QuietVehicle::run, this};
};

/// The radio thread's work on that link, on this thread, for a while.
void watch_radio_thread(benchmark::State& state, std::unique_ptr<Link> owned_link) {
  const Link& link = *owned_link;
  LinkInput input;
  input.name = "benchmark";
  input.link = std::move(owned_link);
  LinkSampleSource source(std::move(input));
  const auto queue = std::make_unique<SampleQueue>();
  const auto events = std::make_unique<EventQueue>();
  LatestValue<InputStatus> status;
  StageHistogram stage_times;
  const SteadyClock clock;
  RadioWorker worker(source, clock, {.refuses_when_full = true}, queue->producer(),
                     InputOutlet{status, events->producer()}, stage_times);
  for (auto _ : state) {  // NOLINT(readability-identifier-naming): as Google Benchmark has it
    const MonotonicTime start = clock.now();
    const Duration cpu_start = thread_cpu_time();
    while (clock.now() - start < kWatched) static_cast<void>(worker.step());
    const Duration cpu = thread_cpu_time() - cpu_start;
    const Duration wall = clock.now() - start;
    state.counters["cpu_percent"] = 100.0 * to_seconds(cpu) / to_seconds(wall);
    state.counters["packets_per_s"] = static_cast<double>(link.statistics().packets_sent) / to_seconds(wall);
  }
  SWIFTLET_CHECK(link.statistics().condition == LinkCondition::kConnected, "the vehicle is received");
}

void idle_udp(benchmark::State& state) {
  const QuietVehicle vehicle;
  SystemLinkClock clock;
  Result<std::unique_ptr<UdpLink>> link = UdpLink::open("127.0.0.1", vehicle.port(), clock);
  SWIFTLET_CHECK(link.ok(), "a loopback address needs no looking up");
  watch_radio_thread(state, std::move(link).value());
}
BENCHMARK(idle_udp)->Iterations(1)->Unit(benchmark::kSecond);

/// A dongle that takes a millisecond for each packet, and a vehicle in range that has nothing to say.
class QuietDongle final : public UsbDevice {
 public:
  UsbTransfer control_out(std::uint8_t /*request*/, std::uint16_t /*value*/, std::uint16_t /*index*/,
                          std::span<const std::uint8_t> data, Duration /*timeout*/) override {
    return {UsbOutcome::kDone, data.size()};
  }
  UsbTransfer bulk_out(std::uint8_t /*endpoint*/, std::span<const std::uint8_t> bytes,
                       Duration /*timeout*/) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    answer_ = vehicle_.on_frame({bytes.begin(), bytes.end()});
    return {UsbOutcome::kDone, bytes.size()};
  }
  UsbTransfer bulk_in(std::uint8_t /*endpoint*/, std::span<std::uint8_t> buffer,
                      Duration /*timeout*/) override {
    if (!answer_) return {UsbOutcome::kTimeout, 0};
    buffer[0] = 0x01;  // acknowledged
    std::copy(answer_->begin(), answer_->end(), buffer.begin() + 1);
    const std::size_t size = answer_->size() + 1;
    answer_.reset();
    return {UsbOutcome::kDone, size};
  }
  UsbOutcome clear_halt(std::uint8_t /*endpoint*/) override { return UsbOutcome::kDone; }
  UsbOutcome reset() override { return UsbOutcome::kDone; }

 private:
  FakeRadioVehicle vehicle_;
  std::optional<Bytes> answer_;
};

class QuietBus final : public UsbBus {
 public:
  std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override {
    UsbIdentity identity;
    identity.vendor = vendor;
    identity.product = product;
    identity.release_bcd = 0x0053;
    return {identity};
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& /*identity*/,
                                                            int /*interface*/) override {
    return std::make_unique<QuietDongle>();
  }
  bool has_changed() override { return false; }
};

void idle_radio(benchmark::State& state) {
  QuietBus bus;
  SystemLinkClock clock;
  watch_radio_thread(state, std::make_unique<RadioLink>(bus, clock, RadioAddress{}));
}
BENCHMARK(idle_radio)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace swiftlet

BENCHMARK_MAIN();
