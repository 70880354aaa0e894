// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/radio_worker.hpp"

namespace swiftlet {

RadioWorker::RadioWorker(SampleSource& source, const Clock& clock, const InputPolicy& policy,
                         SampleQueue::Producer samples, const std::optional<InputOutlet>& outlet,
                         StageHistogram& times)
    : source_(source),
      clock_(clock),
      policy_(policy),
      samples_(samples),
      outlet_(outlet),
      times_(times),
      due_(clock.now()) {
  if (policy_.rate) pacer_.emplace(*policy_.rate);
}

StepResult RadioWorker::step() {
  steps_.fetch_add(1, std::memory_order_relaxed);
  if (ended_) return StepResult::kFinished;
  if (!policy_.refuses_when_full && !samples_.has_room()) return StepResult::kBlocked;
  if (!held_ && !fetch()) return ended_ ? StepResult::kFinished : StepResult::kIdle;
  if (pacer_ && clock_.now() < due_) return StepResult::kIdle;
  hand_on(*held_);
  held_.reset();
  return StepResult::kProgress;
}

void RadioWorker::end_input() {
  if (ended_) return;
  ended_ = true;
  source_.end();
  report_input();
  samples_.close();
}

bool RadioWorker::fetch() {
  const StageTimer timer(clock_, times_);
  const Result<ReceivedSample> next = source_.next();
  if (next) {
    held_ = *next;
    if (pacer_) due_ = pacer_->due(held_->sample.stamp, clock_.now());
    return true;
  }
  if (next.error().code == ErrorCode::kTimeout) {
    report_input();
    return false;
  }
  if (next.error().code != ErrorCode::kEndOfRecording) outcome_ = next.error();
  end_input();
  return false;
}

void RadioWorker::hand_on(ReceivedSample& received) {
  if (!source_.is_live()) received.arrived_at = clock_.now();
  if (break_pending_) {
    received.sample.starts_segment = true;
    received.sample.odometry_ran_on = false;  // the path since the sample handed on before is unknown
  }
  break_pending_ = !samples_.try_push(received) && received.sample.starts_segment;
  report_input();
}

void RadioWorker::report_input() {
  // Taken in any case: the source notes them for its report as they are taken.
  while (const std::optional<VehicleEvent> event = source_.take_event())
    if (outlet_) static_cast<void>(outlet_->events.try_push(*event));
  if (!outlet_) return;
  const InputReport& report = source_.report();
  const LiveStatus live = source_.live_status().value_or(LiveStatus{});
  has_client_.store(live.sharing.has_client, std::memory_order_relaxed);
  outlet_->status.store({.counters = report.counters,
                         .problems = report.problems.size(),
                         .progress = source_.progress().value_or(-1.0),
                         .ended = ended_,
                         .live = live});
}

}  // namespace swiftlet
