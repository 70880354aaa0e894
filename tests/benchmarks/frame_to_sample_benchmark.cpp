// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// From a radio frame in the link's hands to its sample in the frontend's queue.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "core/base/check.hpp"
#include "daemon/workers/radio_worker.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {
namespace {

/// Answers the handshake at once; then every receive() brings the log packet of another 100 ms, after a
/// pause.
class EagerLink final : public Link {
 public:
  Duration pause{};
  MonotonicTime handed_over{};  ///< when the latest frame left receive()

  EagerLink() { vehicle_.variables = ScriptedVehicle::modern_variables(); }
  Status send(std::span<const std::uint8_t> packet) override {
    frames_.push_back(sent({packet.begin(), packet.end()}, now_));
    if (const std::optional<Bytes> reply = vehicle_.answer(packet)) frames_.push_back(received(*reply, now_));
    return {};
  }
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    if (frames_.empty()) {
      now_ += std::chrono::milliseconds(100);
      const auto time_ms = static_cast<std::uint32_t>(now_.time_since_epoch() / std::chrono::milliseconds(1));
      for (const Bytes& packet : vehicle_.data(time_ms)) frames_.push_back(received(packet, now_));
      if (pause > Duration::zero()) std::this_thread::sleep_for(pause);
    }
    const LinkFrame frame = frames_.front();
    frames_.pop_front();
    handed_over = std::chrono::steady_clock::now();
    return frame;
  }

 private:
  ScriptedVehicle vehicle_;
  std::deque<LinkFrame> frames_;
  HostTime now_{};
};

void frame_to_queued_sample(benchmark::State& state) {
  auto owned_link = std::make_unique<EagerLink>();
  EagerLink& link = *owned_link;
  LinkInput input;
  input.name = "benchmark";
  input.starts_logging = true;
  input.link = std::move(owned_link);
  LinkSampleSource source(std::move(input));
  const auto queue = std::make_unique<SampleQueue>();
  SampleQueue::Consumer consumer = queue->consumer();
  const auto events = std::make_unique<EventQueue>();
  LatestValue<InputStatus> status;
  StageHistogram stage_times;
  const SteadyClock clock;
  RadioWorker worker(source, clock, {.refuses_when_full = true}, queue->producer(),
                     InputOutlet{status, events->producer()}, stage_times);
  ReceivedSample sample;
  while (!consumer.try_pop(sample)) static_cast<void>(worker.step());  // the handshake

  link.pause = std::chrono::microseconds(state.range(0));
  StageHistogram latencies;
  for (auto _ : state) {  // NOLINT(readability-identifier-naming,clang-analyzer-deadcode.DeadStores): as
                          // Google Benchmark has it
    static_cast<void>(worker.step());
    const Duration took = std::chrono::steady_clock::now() - link.handed_over;
    SWIFTLET_CHECK(consumer.try_pop(sample), "every log packet makes a sample");
    latencies.record(took);
    state.SetIterationTime(to_seconds(took));
  }
  const StageSummary summary = latencies.summary("");
  state.counters["p50_us"] = 1e3 * summary.p50_ms;
  state.counters["p99_us"] = 1e3 * summary.p99_ms;
  state.counters["max_us"] = 1e3 * summary.max_ms;
}
// Back to back, and with pauses in which the caches cool down and the processor dozes off.
BENCHMARK(frame_to_queued_sample)->ArgName("pause_us")->Arg(0)->Iterations(200'000)->UseManualTime();
BENCHMARK(frame_to_queued_sample)->ArgName("pause_us")->Arg(1'000)->Iterations(20'000)->UseManualTime();

}  // namespace
}  // namespace swiftlet

BENCHMARK_MAIN();
