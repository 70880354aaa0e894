// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/backend_worker.hpp"

#include <utility>

#include "daemon/workers/map_again.hpp"

namespace swiftlet {

BackendWorker::BackendWorker(const MappingSettings& settings, Backend& backend, MapBuilder& map,
                             const Clock& clock, StepQueue::Consumer steps, CorrectionValue& correction,
                             const std::optional<BackendOutlet>& publisher, StageTimes& times)
    : settings_(settings),
      backend_(backend),
      map_(map),
      clock_(clock),
      steps_(steps),
      correction_(correction),
      times_(times) {
  if (publisher) feed_.emplace(*publisher);
}

void BackendWorker::execute_commands_by(CommandQueue::Consumer commands, CommandHandler handler) {
  commands_ = commands;
  handler_ = std::move(handler);
}

StepResult BackendWorker::step() {
  execute_commands();
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

void BackendWorker::execute_commands() {
  Command command;
  while (commands_ && commands_->try_pop(command)) {
    std::optional<HostTime> newest;
    if (backend_.scans().size() > 0) newest = step_.sample.stamp;
    handler_(command, map_, newest);
  }
}

void BackendWorker::add_step() {
  BackendUpdate changed;
  {
    const StageTimer timer(clock_, times_.backend);
    changed = backend_.add(step_);
  }
  if (feed_) feed_->hand_on_confidence(backend_, step_.has_keyframe);
  if (!step_.has_keyframe) {
    if (feed_ && map_.is_behind(backend_)) draw([&] { return map_.catch_up(backend_); });
    return;
  }
  hand_on_correction();
  if (feed_) draw([&] { return map_.update(backend_, changed.poses_changed, changed.refined); });
  prune();
}

void BackendWorker::prune() {
  const StageTimer timer(clock_, times_.pruning);
  const Pruning pruning = backend_.next_pruning();
  if (pruning.empty()) return;
  if (pruned_ != nullptr) pruned_->take(backend_, pruning);
  if (feed_) {
    map_.prune(backend_, pruning);
    feed_->prune(backend_, pruning);
  }
  backend_.prune(pruning);
}

void BackendWorker::run_final_pass() {
  {
    const StageTimer timer(clock_, times_.final_pass);
    static_cast<void>(backend_.finish(
        [&](std::span<const double> step_scale) { return map_again(backend_, settings_, step_scale); }));
  }
  final_pass_done_ = true;
  hand_on_correction();
  draw([&] { return map_.settle(backend_); });
}

template <typename Drawing>
void BackendWorker::draw(Drawing drawing) {
  const StageTimer timer(clock_, times_.map);
  const std::vector<TileIndex> changed = drawing();
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
