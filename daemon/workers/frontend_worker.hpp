// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>

#include "core/frontend/frontend.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/stage_times.hpp"
#include "daemon/workers/worker.hpp"

namespace swiftlet {

/// Takes each sample through the frontend, composes the newest correction with its answer, and hands both on.
/// One thread at a time.
/// @note A step allocates nothing, takes no lock and logs nothing.
class FrontendWorker {
 public:
  /// References must outlive the worker, except `beams`, which is copied: the bearings of this run's beams.
  /// Without `publisher` poses go to the backend alone.
  FrontendWorker(Frontend& frontend, const Clock& clock, SampleQueue::Consumer samples,
                 StepQueue::Producer steps, CorrectionValue& correction,
                 std::optional<FrontendOutlet> publisher, const BeamReadings& beams, StageHistogram& times);

  StepResult step() noexcept;
  /// Sleeps until a sample waits or no more will come.
  void wait() const noexcept { samples_.wait(); }

 private:
  Frontend& frontend_;
  const Clock& clock_;
  SampleQueue::Consumer samples_;
  StepQueue::Producer steps_;
  CorrectionValue& correction_;
  std::optional<FrontendOutlet> publisher_;
  StageHistogram& times_;
  ReceivedSample received_;
  MapCorrection applied_;      // the newest correction ...
  double correction_m_ = 0.0;  // ... and by how far it moved the pose
  Pose2 T_local_body_;         // of the sample before
  PoseConfidence confidence_;  // likewise
  KeyframeId restarted_at_{};  // of the newest sample to which no odometry leads
  BeamReadings beams_;         // of the newest sample
  std::uint32_t segment_ = 0;

  const FrontendStep& process() noexcept;
  void take_correction() noexcept;
  void report(const FrontendStep& step) noexcept;
  [[nodiscard]] Tracking tracking() const noexcept;
};

}  // namespace swiftlet
