// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>

#include "core/backend/backend.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/workers/command_handler.hpp"
#include "daemon/workers/run_timing.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

class BackendWorker;
class Clock;
class FrontendWorker;
class RadioWorker;
class PrunedScans;
struct InputPolicy;
struct PipelineQueues;

/// The workers (radio, frontend, backend) and the queues between them, wired for one input. In lockstep one
/// thread calls step(); the daemon gives each worker a thread of its own. The same steps either way.
class Pipeline {
 public:
  /// For lockstep: samples are taken as fast as they are read, nobody publishes. `source` must outlive the
  /// pipeline. Precondition: config.validate() is empty.
  Pipeline(const Configuration& config, SampleSource& source);
  /// For threads: samples are taken by `policy`, and what a publisher needs goes to
  /// queues().to_publisher. `clock` must outlive the pipeline.
  Pipeline(const Configuration& config, SampleSource& source, const Clock& clock, const InputPolicy& policy);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// As BackendWorker::keep_pruned(). Before the first step.
  void keep_pruned(PrunedScans& pruned);

  /// As BackendWorker::execute_commands_by(). Before the first step.
  void execute_commands_by(CommandHandler handler);
  /// For the backend, which is woken. False: too many wait. One thread at a time.
  [[nodiscard]] bool command(const Command& command);

  /// Those that came behind the backend's last step. Not while threads run.
  void execute_commands();
  /// Whether another program uses the vehicle over this link. Any thread.
  [[nodiscard]] bool has_client() const;

  /// Lockstep: takes the next sample through all stages in the calling thread. False when the input has ended
  /// and the backend's final pass is done. Errors: whatever ended the input before its time, returned once
  /// the final pass is done (outputs are valid).
  [[nodiscard]] Result<bool> step();

  // Not while threads run.
  [[nodiscard]] const Backend& backend() const;
  [[nodiscard]] Backend& backend();
  [[nodiscard]] const Frontend& frontend() const;
  [[nodiscard]] const MapBuilder& map() const;
  /// What ended the input before its time, if anything did.
  [[nodiscard]] const Status& outcome() const;

  /// Any thread. Allocates.
  [[nodiscard]] std::vector<StageSummary> stage_times() const;
  /// Any thread. Allocates.
  [[nodiscard]] RunTiming timing() const;

  // For whoever gives each worker its thread.
  [[nodiscard]] RadioWorker& radio_worker();
  [[nodiscard]] FrontendWorker& frontend_worker();
  [[nodiscard]] BackendWorker& backend_worker();
  [[nodiscard]] PipelineQueues& queues();
  /// For whoever publishes poses.
  [[nodiscard]] PoseLatency& pose_latency();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
