// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>

#include "core/backend/backend.hpp"
#include "core/mapping/map_builder.hpp"
#include "core/run/mapping_run.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/command_handler.hpp"
#include "daemon/workers/map_feed.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "daemon/workers/stage_times.hpp"
#include "daemon/workers/worker.hpp"

namespace swiftlet {

/// Adds each frontend step to the backend, draws the map at keyframes, and between them while it is behind,
/// and passes corrections to the frontend and changes to the publisher. Without a publisher the map is drawn
/// once, at the end. After the last step comes the final pass. One thread at a time; may allocate and may be
/// slow.
class BackendWorker {
 public:
  /// References must outlive the worker.
  /// `settings`: what the run is mapped with.
  BackendWorker(const MappingSettings& settings, Backend& backend, MapBuilder& map, const Clock& clock,
                StepQueue::Consumer steps, CorrectionValue& correction,
                const std::optional<BackendOutlet>& publisher, StageTimes& times);

  /// Trajectories will be written: what is pruned is kept there, which must outlive the worker.
  void keep_pruned(PrunedScans& pruned) { pruned_ = &pruned; }

  /// Each command is given to `handler` before the next step. Before the first step.
  void execute_commands_by(CommandQueue::Consumer commands, CommandHandler handler);
  /// Those that wait. A step does so by itself.
  void execute_commands();

  /// kBlocked: only the publisher's queues stand in the way; call again in a moment.
  StepResult step();
  /// Sleeps until a step or a command waits or no more will come.
  void wait() const noexcept {
    steps_.wait_unless([this] { return commands_ && commands_->size() > 0; });
  }

 private:
  MappingSettings settings_;
  Backend& backend_;
  MapBuilder& map_;
  const Clock& clock_;
  StepQueue::Consumer steps_;
  CorrectionValue& correction_;
  std::optional<MapFeed> feed_;
  StageTimes& times_;
  PrunedScans* pruned_ = nullptr;
  std::optional<CommandQueue::Consumer> commands_;
  CommandHandler handler_;
  FrontendStep step_;
  std::uint32_t correction_version_ = 0;
  bool final_pass_done_ = false;

  void add_step();
  void prune();
  void run_final_pass();
  template <typename Drawing>
  void draw(Drawing drawing);
  void hand_on_correction();
  /// False while the publisher's queues have no room for all of it.
  [[nodiscard]] bool hand_on_changes();
};

}  // namespace swiftlet
