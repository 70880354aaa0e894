// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/stage_times.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace swiftlet {
namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;

double to_ms(double nanoseconds) { return nanoseconds * 1e-6; }

}  // namespace

void StageHistogram::record(Duration took) noexcept {
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(took.count(), 0));
  std::atomic<std::uint64_t>& bucket = counts_[bucket_of(ns)];
  bucket.store(bucket.load(kRelaxed) + 1, kRelaxed);
  sum_ns_.store(sum_ns_.load(kRelaxed) + ns, kRelaxed);
  max_ns_.store(std::max(max_ns_.load(kRelaxed), ns), kRelaxed);
  count_.store(count_.load(kRelaxed) + 1, kRelaxed);
}

StageSummary StageHistogram::summary(std::string name) const {
  StageSummary out;
  out.name = std::move(name);
  out.count = count_.load(kRelaxed);
  if (out.count == 0) return out;
  out.max_ms = to_ms(static_cast<double>(max_ns_.load(kRelaxed)));
  out.mean_ms = to_ms(static_cast<double>(sum_ns_.load(kRelaxed)) / static_cast<double>(out.count));
  out.p50_ms = std::min(percentile_ms(out.count, 0.50), out.max_ms);
  out.p99_ms = std::min(percentile_ms(out.count, 0.99), out.max_ms);
  out.p999_ms = std::min(percentile_ms(out.count, 0.999), out.max_ms);
  return out;
}

StageBuckets StageHistogram::buckets(std::string name) const {
  StageBuckets out{.name = std::move(name), .buckets = {}};
  for (std::size_t i = 0; i < kBuckets; ++i)
    if (const std::uint64_t count = counts_[i].load(kRelaxed); count > 0)
      out.buckets.push_back({.upper_ns = upper_end_of(i), .count = count});
  return out;
}

// Below kSubBuckets each value has a bucket of its own; above, the kSubBits bits after the leading one choose
// among the buckets of its doubling.
std::size_t StageHistogram::bucket_of(std::uint64_t nanoseconds) noexcept {
  const std::uint64_t value = std::min(nanoseconds, (std::uint64_t{1} << kValueBits) - 1);
  if (value < kSubBuckets) return static_cast<std::size_t>(value);
  const std::size_t shift = static_cast<std::size_t>(std::bit_width(value)) - kSubBits - 1;
  return shift * kSubBuckets + static_cast<std::size_t>(value >> shift);
}

std::uint64_t StageHistogram::upper_end_of(std::size_t bucket) noexcept {
  if (bucket < 2 * kSubBuckets) return bucket;
  const std::size_t shift = bucket / kSubBuckets - 1;
  const std::uint64_t leading = bucket - shift * kSubBuckets;
  return ((leading + 1) << shift) - 1;
}

double StageHistogram::percentile_ms(std::uint64_t count, double share) const noexcept {
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count)));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    seen += counts_[i].load(kRelaxed);
    if (seen >= rank) return to_ms(static_cast<double>(upper_end_of(i)));
  }
  return to_ms(static_cast<double>(upper_end_of(kBuckets - 1)));
}

std::vector<StageSummary> StageTimes::summaries(const PoseLatency& latency) const {
  return {input.summary("input"),
          frontend.summary("frontend"),
          backend.summary("backend"),
          final_pass.summary("final_pass"),
          map.summary("map"),
          pruning.summary("pruning"),
          latency.times().summary("frame_to_pose")};
}

std::vector<StageBuckets> StageTimes::buckets(const PoseLatency& latency) const {
  return {input.buckets("input"),
          frontend.buckets("frontend"),
          backend.buckets("backend"),
          final_pass.buckets("final_pass"),
          map.buckets("map"),
          pruning.buckets("pruning"),
          latency.times().buckets("frame_to_pose")};
}

}  // namespace swiftlet
