// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "core/base/result.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/pacer.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/stage_times.hpp"
#include "daemon/workers/worker.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// How samples enter the pipeline.
struct InputPolicy {
  /// Recordings: replay at this many times the pace of the samples' own stamps; empty: as fast as they are
  /// read.
  std::optional<double> rate{};
  /// False for recordings, which wait for room. True for a live link, which cannot be asked to wait.
  bool refuses_when_full = false;
};

/// Takes samples from the input and hands them to the frontend, when they are due. One thread at a time.
/// @note A step allocates nothing (beyond what the source's own next() does), takes no lock and logs nothing.
class RadioWorker {
 public:
  /// References must outlive the worker. Without an outlet nothing is reported.
  RadioWorker(SampleSource& source, const Clock& clock, const InputPolicy& policy,
              SampleQueue::Producer samples, const std::optional<InputOutlet>& outlet, StageHistogram& times);

  /// kProgress: one sample handed on (or refused). kIdle: none due before due(), or the link was silent.
  StepResult step();
  /// How often step() was called: stands still when it hangs. Any thread.
  [[nodiscard]] std::uint64_t steps() const { return steps_.load(std::memory_order_relaxed); }
  /// Whether another program uses the vehicle over this link. Any thread.
  [[nodiscard]] bool has_client() const { return has_client_.load(std::memory_order_relaxed); }
  /// When the next sample is due; now or earlier when none is waiting.
  [[nodiscard]] MonotonicTime due() const { return due_; }
  /// Takes no further samples, as if the input had ended here.
  void end_input();
  /// What ended the input before its time, if anything did.
  [[nodiscard]] const Status& outcome() const { return outcome_; }

 private:
  SampleSource& source_;
  const Clock& clock_;
  InputPolicy policy_;
  SampleQueue::Producer samples_;
  std::optional<InputOutlet> outlet_;
  StageHistogram& times_;
  std::optional<Pacer> pacer_;
  std::optional<ReceivedSample> held_;  // read, not yet due
  MonotonicTime due_{};
  bool break_pending_ = false;  // a refused sample began a segment: the next one handed on must do so
  bool ended_ = false;
  std::atomic<std::uint64_t> steps_{0};
  std::atomic<bool> has_client_{false};
  Status outcome_;

  bool fetch();
  void hand_on(ReceivedSample& received);
  void report_input();
};

}  // namespace swiftlet
