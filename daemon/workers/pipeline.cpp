// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/pipeline.hpp"

#include <optional>
#include <utility>

#include "core/base/check.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/backend_worker.hpp"
#include "daemon/workers/frontend_worker.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/radio_worker.hpp"

namespace swiftlet {
namespace {

const Clock& steady_clock() {
  static const SteadyClock kClock;
  return kClock;
}

}  // namespace

struct Pipeline::State {
  State(const Configuration& config, SampleSource& source, const Clock& clock, const InputPolicy& policy,
        bool publishes_all)
      : sensor(config.sensor.applied_to(source.sensor())),
        frontend(config.frontend, sensor, source.beams()),
        backend(config.backend, sensor, source.beams()),
        map(config.map, sensor),
        publishes(publishes_all),
        pose_latency(from_seconds(config.realtime.pose_deadline_s)),
        radio_worker(source, clock, policy, queues.samples.producer(), input_outlet(), times.input),
        frontend_worker(frontend, clock, queues.samples.consumer(), queues.steps.producer(),
                        queues.correction, frontend_outlet(), BeamReadings::of(source.beams(), sensor),
                        times.frontend),
        backend_worker({config.frontend, config.backend, sensor}, backend, map, clock,
                       queues.steps.consumer(), queues.correction, backend_outlet(), times) {}

  std::optional<InputOutlet> input_outlet() {
    if (!publishes) return std::nullopt;
    return queues.to_publisher.input_outlet();
  }
  std::optional<FrontendOutlet> frontend_outlet() {
    if (!publishes) return std::nullopt;
    return queues.to_publisher.frontend_outlet();
  }
  std::optional<BackendOutlet> backend_outlet() {
    if (!publishes) return std::nullopt;
    return queues.to_publisher.backend_outlet();
  }

  SensorModel sensor;
  Frontend frontend;
  Backend backend;
  MapBuilder map;
  PipelineQueues queues;
  bool publishes;
  StageTimes times;
  PoseLatency pose_latency;
  RadioWorker radio_worker;
  FrontendWorker frontend_worker;
  BackendWorker backend_worker;
};

Pipeline::Pipeline(const Configuration& config, SampleSource& source)
    : state_(std::make_unique<State>(config, source, steady_clock(), InputPolicy{}, false)) {}

Pipeline::Pipeline(const Configuration& config, SampleSource& source, const Clock& clock,
                   const InputPolicy& policy)
    : state_(std::make_unique<State>(config, source, clock, policy, true)) {}

Pipeline::~Pipeline() = default;

void Pipeline::keep_pruned(PrunedScans& pruned) { state_->backend_worker.keep_pruned(pruned); }

void Pipeline::execute_commands_by(CommandHandler handler) {
  state_->backend_worker.execute_commands_by(state_->queues.commands.consumer(), std::move(handler));
}

bool Pipeline::command(const Command& command) {
  const bool is_taken = state_->queues.commands.producer().try_push(command);
  state_->queues.steps.wake();
  return is_taken;
}

void Pipeline::execute_commands() { state_->backend_worker.execute_commands(); }

bool Pipeline::has_client() const { return state_->radio_worker.has_client(); }

Result<bool> Pipeline::step() {
  state_->radio_worker.step();
  state_->frontend_worker.step();
  if (state_->backend_worker.step() != StepResult::kFinished) return true;
  if (!outcome()) return outcome().error();
  return false;
}

const Backend& Pipeline::backend() const { return state_->backend; }
Backend& Pipeline::backend() { return state_->backend; }
const Frontend& Pipeline::frontend() const { return state_->frontend; }
const MapBuilder& Pipeline::map() const { return state_->map; }
const Status& Pipeline::outcome() const { return state_->radio_worker.outcome(); }
std::vector<StageSummary> Pipeline::stage_times() const {
  return state_->times.summaries(state_->pose_latency);
}

RunTiming Pipeline::timing() const {
  RunTiming out{.stages = stage_times(),
                .buckets = state_->times.buckets(state_->pose_latency),
                .queues = {},
                .pose_deadline = state_->pose_latency.deadline(),
                .missed_deadlines = state_->pose_latency.missed()};
  const auto queues = state_->queues.statistics();
  if (state_->publishes) out.queues.assign(queues.begin(), queues.end());
  return out;
}

RadioWorker& Pipeline::radio_worker() { return state_->radio_worker; }
FrontendWorker& Pipeline::frontend_worker() { return state_->frontend_worker; }
BackendWorker& Pipeline::backend_worker() { return state_->backend_worker; }
PipelineQueues& Pipeline::queues() { return state_->queues; }
PoseLatency& Pipeline::pose_latency() { return state_->pose_latency; }

}  // namespace swiftlet
