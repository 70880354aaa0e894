// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/frontend_worker.hpp"

#include "core/base/check.hpp"

namespace swiftlet {

FrontendWorker::FrontendWorker(Frontend& frontend, const Clock& clock, SampleQueue::Consumer samples,
                               StepQueue::Producer steps, CorrectionValue& correction,
                               std::optional<FrontendOutlet> publisher, const BeamReadings& beams,
                               StageHistogram& times)
    : frontend_(frontend),
      clock_(clock),
      samples_(samples),
      steps_(steps),
      correction_(correction),
      publisher_(publisher),
      times_(times),
      beams_(beams) {}

StepResult FrontendWorker::step() noexcept {
  if (!steps_.has_room()) return StepResult::kBlocked;
  const bool ended = samples_.closed();
  if (!samples_.try_pop(received_)) {
    if (!ended) return StepResult::kIdle;
    steps_.close();
    return StepResult::kFinished;
  }
  const FrontendStep& step = process();
  const bool pushed = steps_.try_push(step);
  SWIFTLET_CHECK(pushed, "only this worker fills the queue of steps, and it had room");
  if (publisher_) report(step);
  return StepResult::kProgress;
}

void FrontendWorker::take_correction() noexcept {
  const Point2 before = applied_.T_map_local * T_local_body_.position();
  if (!correction_.load_if_new(applied_)) return;
  const Point2 after = applied_.T_map_local * T_local_body_.position();
  correction_m_ = distance_m(before, after);
}

const FrontendStep& FrontendWorker::process() noexcept {
  take_correction();
  const StageTimer timer(clock_, times_);
  return frontend_.process(received_.sample, applied_.T_map_local);
}

/// A restart makes a keyframe, with which the backend's answer comes.
Tracking FrontendWorker::tracking() const noexcept {
  const bool is_answered = confidence_.keyframe >= restarted_at_;
  return is_answered || !confidence_.has_older_map ? confidence_.figures.tracking : Tracking::kLost;
}

void FrontendWorker::report(const FrontendStep& step) noexcept {
  const RangeSample& sample = received_.sample;
  T_local_body_ = step.T_local_body;
  if (sample.starts_segment) ++segment_;
  if (sample.starts_segment && !sample.odometry_ran_on) restarted_at_ = step.keyframe;
  static_cast<void>(publisher_->confidence.load_if_new(confidence_));
  beams_.distance_m = sample.distance_m;
  beams_.status = sample.status;
  // A refused pose is counted by the queue.
  static_cast<void>(publisher_->poses.try_push(
      {.stamp = sample.stamp,
       .sequence = sample.sequence,
       .segment = segment_,
       .keyframe = step.keyframe,
       .correction_version = applied_.version,
       .correction_m = correction_m_,
       .T_map_body = step.T_map_body,
       .T_local_body = step.T_local_body,
       .T_odom_body = sample.T_odom_body,
       .storey = sample.storey,
       .tracking = tracking(),
       .from_start = carried_on(confidence_.from_start, confidence_, step.T_local_body),
       .from_surroundings = carried_on(confidence_.from_surroundings, confidence_, step.T_local_body),
       .measured_at = sample.measured_at,
       .beams = beams_,
       .arrived_at = received_.arrived_at}));
  publisher_->counters.store(frontend_.counters());
}

}  // namespace swiftlet
