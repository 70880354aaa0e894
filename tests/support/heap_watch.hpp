// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <pthread.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "daemon/system/clock.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "tests/support/allocation_counter.hpp"

// How a test looks over the shoulders of the daemon's threads while they run.

namespace swiftlet::test {

/// What one thread did with the heap between two moments. Told by that thread, asked when it is over.
class HeapSpan {
 public:
  /// The span lasts until now.
  void extend() {
    const HeapCalls now = heap_calls_of_this_thread() - excluded_;
    if (!began_) began_ = now;
    ended_ = now;
  }
  /// Calls `work`, which does not count.
  template <typename Work>
  auto without(Work work) {
    const HeapCalls before = heap_calls_of_this_thread();
    auto result = work();
    const HeapCalls during = heap_calls_of_this_thread() - before;
    excluded_ = {excluded_.taken + during.taken, excluded_.given_back + during.given_back};
    return result;
  }
  [[nodiscard]] HeapCalls calls() const { return began_ ? ended_ - *began_ : HeapCalls{}; }

 private:
  std::optional<HeapCalls> began_;
  HeapCalls ended_;
  HeapCalls excluded_;
};

/// The machine's clock; each look of the thread of that name extends the span.
class WatchfulClock final : public Clock {
 public:
  explicit WatchfulClock(std::string_view thread) : thread_(thread) {}
  [[nodiscard]] MonotonicTime now() const override {
    std::array<char, 16> name{};
    pthread_getname_np(pthread_self(), name.data(), name.size());
    if (thread_ == name.data()) span_.extend();
    return clock_.now();
  }
  void sleep_until(MonotonicTime wake_at) override { clock_.sleep_until(wake_at); }
  void wait_for(EventCount& event_count, std::uint32_t received, MonotonicTime wake_at) override {
    clock_.wait_for(event_count, received, wake_at);
  }
  [[nodiscard]] const HeapSpan& span() const { return span_; }

 private:
  std::string_view thread_;
  SteadyClock clock_;
  mutable HeapSpan span_;  // of that thread alone
};

/// Another source, watched from one of its samples, counted from 1, to the call that returns the end.
class WatchedSource final : public SampleSource {
 public:
  WatchedSource(SampleSource& source, HeapSpan& span, std::size_t from)
      : source_(source), span_(span), from_(from) {}
  [[nodiscard]] Result<ReceivedSample> next() override {
    if (samples_ >= from_) span_.extend();
    Result<ReceivedSample> received = source_.next();
    if (received && ++samples_ == from_) span_.extend();
    return received;
  }
  [[nodiscard]] const BeamLayout& beams() const override { return source_.beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return source_.sensor(); }
  [[nodiscard]] const InputReport& report() const override { return source_.report(); }
  [[nodiscard]] std::optional<double> progress() const override { return source_.progress(); }
  [[nodiscard]] bool is_live() const override { return source_.is_live(); }
  [[nodiscard]] std::optional<LiveStatus> live_status() const override { return source_.live_status(); }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override { return source_.take_event(); }
  void end() override { source_.end(); }
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return source_.ground_truth(); }

  [[nodiscard]] std::size_t samples() const { return samples_; }

 private:
  SampleSource& source_;
  HeapSpan& span_;
  std::size_t from_;
  std::size_t samples_ = 0;
};

}  // namespace swiftlet::test
