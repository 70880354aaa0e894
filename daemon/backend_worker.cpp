// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/backend_worker.hpp"

namespace swiftlet {

BackendWorker::BackendWorker(Backend& backend, MapBuilder& map, const Clock& clock, StepQueue::Consumer steps,
                             CorrectionValue& correction, const std::optional<BackendOutlet>& publisher,
                             StageTimes& times)
    : backend_(backend), map_(map), clock_(clock), steps_(steps), correction_(correction), times_(times) {
  if (publisher) feed_.emplace(*publisher);
}

StepResult BackendWorker::step() {
  const bool ended = steps_.closed();
  if (steps_.try_pop(step_)) {
    add_step();
    static_cast<void>(hand_on_changes());  // the rest is offered again with the next step
    return StepResult::kProgress;
  }
  if (ended && !final_pass_done_) run_final_pass();
  if (!hand_on_changes()) return StepResult::kBlocked;
  if (!final_pass_done_) return StepResult::kIdle;
  if (feed_) feed_->close();
  return StepResult::kFinished;
}

void BackendWorker::add_step() {
  {
    const StageTimer timer(clock_, times_.backend);
    changed_ = backend_.add(step_);
  }
  if (!step_.has_keyframe) return;
  hand_on_correction();
  draw_map();
}

void BackendWorker::run_final_pass() {
  {
    const StageTimer timer(clock_, times_.final_pass);
    changed_ = backend_.finish();
  }
  final_pass_done_ = true;
  changed_.poses_changed = true;
  hand_on_correction();
  draw_map();
}

void BackendWorker::draw_map() {
  const StageTimer timer(clock_, times_.map);
  const std::vector<TileIndex> changed = map_.update(backend_, changed_.poses_changed, changed_.refined);
  if (feed_) feed_->note_changes(changed);
}

void BackendWorker::hand_on_correction() {
  const MapCorrection correction = backend_.correction();
  if (correction.version == correction_version_) return;
  correction_version_ = correction.version;
  correction_.store(correction);
}

bool BackendWorker::hand_on_changes() {
  if (!feed_) return true;
  feed_->flush(backend_, map_);
  return feed_->is_empty();
}

}  // namespace swiftlet
