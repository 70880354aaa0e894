// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/time.hpp"
#include "daemon/system/clock.hpp"

namespace swiftlet {

/// How long one stage took over a run.
struct StageSummary {
  /// "input", "frontend", "backend", "final_pass", "map", "pruning", "frame_to_pose"
  std::string name;
  std::uint64_t count = 0;
  double mean_ms = 0.0;
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double p999_ms = 0.0;
  double max_ms = 0.0;
};

/// A histogram as it is written down: what was counted, bucket by bucket.
struct StageBuckets {
  std::string name;  ///< as in StageSummary
  struct Bucket {
    std::uint64_t upper_ns = 0;  ///< the longest duration that is counted here
    std::uint64_t count = 0;
  };
  std::vector<Bucket> buckets;  ///< in ascending order, those that hold anything
};

/// Counts durations in log-linear buckets after Tene's HdrHistogram: 32 buckets to each doubling, so a
/// percentile is at most 1/32 too high; mean and maximum are exact. Durations beyond about 18 minutes count
/// as that long.
/// @note Fixed storage, no lock. One thread records, any thread reads.
class StageHistogram {
 public:
  void record(Duration took) noexcept;
  /// Allocates for the name only.
  [[nodiscard]] StageSummary summary(std::string name) const;
  /// Allocates.
  [[nodiscard]] StageBuckets buckets(std::string name) const;

 private:
  static constexpr std::size_t kSubBits = 5;
  static constexpr std::size_t kSubBuckets = std::size_t{1} << kSubBits;
  static constexpr std::size_t kValueBits = 40;
  static constexpr std::size_t kBuckets = (kValueBits - kSubBits + 1) * kSubBuckets;

  static std::size_t bucket_of(std::uint64_t nanoseconds) noexcept;
  static std::uint64_t upper_end_of(std::size_t bucket) noexcept;
  [[nodiscard]] double percentile_ms(std::uint64_t count, double share) const noexcept;

  // Written by the recording thread only, hence plain relaxed stores.
  std::array<std::atomic<std::uint64_t>, kBuckets> counts_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> sum_ns_{0};
  std::atomic<std::uint64_t> max_ns_{0};
};

/// The way of each sample from the radio frame that completed it to its published pose, against a deadline.
/// @note Fixed storage, no lock. One thread records, any thread reads.
class PoseLatency {
 public:
  explicit PoseLatency(Duration deadline) : deadline_(deadline) {}
  void record(Duration took) noexcept {
    times_.record(took);
    if (took > deadline_)
      missed_.store(missed_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  [[nodiscard]] const StageHistogram& times() const { return times_; }
  [[nodiscard]] Duration deadline() const { return deadline_; }
  [[nodiscard]] std::uint64_t missed() const { return missed_.load(std::memory_order_relaxed); }

 private:
  Duration deadline_;
  StageHistogram times_;
  std::atomic<std::uint64_t> missed_{0};  // written by the recording thread only
};

/// The stages of the pipeline; each is recorded by the one worker that runs it.
struct StageTimes {
  StageHistogram input;       ///< SampleSource::next()
  StageHistogram frontend;    ///< Frontend::process()
  StageHistogram backend;     ///< Backend::add()
  StageHistogram final_pass;  ///< Backend::finish()
  StageHistogram map;         ///< MapBuilder::settle(); before it, with a publisher, each update()
  StageHistogram pruning;     ///< choosing and forgetting redundant scans

  [[nodiscard]] std::vector<StageSummary> summaries(const PoseLatency& latency) const;
  [[nodiscard]] std::vector<StageBuckets> buckets(const PoseLatency& latency) const;
};

/// Records the time from its making to its end.
class StageTimer {
 public:
  StageTimer(const Clock& clock, StageHistogram& histogram)
      : clock_(clock), histogram_(histogram), started_(clock.now()) {}
  ~StageTimer() { histogram_.record(clock_.now() - started_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  const Clock& clock_;
  StageHistogram& histogram_;
  MonotonicTime started_;
};

}  // namespace swiftlet
