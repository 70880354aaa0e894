// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/daemon.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include "daemon/system/thread_setup.hpp"
#include "daemon/workers/backend_worker.hpp"
#include "daemon/workers/frontend_worker.hpp"
#include "daemon/workers/pipeline_queues.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

constexpr MonotonicTime::duration kRoomWait = milliseconds(1);   // before looking again at a full queue
constexpr MonotonicTime::duration kStopWait = milliseconds(20);  // the longest a stop goes unnoticed

/// Asks for all of it, and logs in one line what was refused.
class RealtimeRequest {
 public:
  void ask(const Status& answer, const std::string& of) {
    if (!answer) refused_ += (refused_.empty() ? "" : "; ") + of + answer.error().message;
  }
  void log_refused() const {
    if (!refused_.empty())
      spdlog::warn("real time: not granted: {}; runs on without, docs/real_time.md has what to permit",
                   refused_);
  }

 private:
  std::string refused_;
};

}  // namespace

Daemon::Daemon(const Configuration& config, SampleSource& source, Clock& clock, const InputPolicy& policy,
               Publisher& publisher)
    : realtime_(config.realtime),
      clock_(clock),
      pipeline_(config, source, clock, policy),
      publisher_worker_(config.publish, config.map.resolution_m, pipeline_.queues().to_publisher.inlet(),
                        {.queues = [this] { return pipeline_.queues().statistics(); },
                         .stages = [this] { return pipeline_.stage_times(); },
                         .pose_latency = pipeline_.pose_latency(),
                         .recording = [this] { return recording_(); }},
                        publisher, clock) {}

Status Daemon::run(const std::stop_token& stop) {
  RealtimeRequest request;
  if (realtime_.lock_memory) request.ask(lock_memory(), "");
  {
    std::jthread publisher = thread("publisher", [this] { run_publisher(); });
    std::jthread backend = thread("backend", [this] { run_to_end(pipeline_.backend_worker()); });
    std::jthread frontend = thread("frontend", [this] { run_to_end(pipeline_.frontend_worker()); });
    std::jthread radio = thread("radio", [this, &stop] { run_radio(stop); });
    request.ask(
        set_up_thread(publisher.native_handle(), {realtime_.publisher_priority, realtime_.publisher_cpu}),
        "publisher: ");
    request.ask(set_up_thread(backend.native_handle(), {0, realtime_.backend_cpu}), "backend: ");
    request.ask(
        set_up_thread(frontend.native_handle(), {realtime_.frontend_priority, realtime_.frontend_cpu}),
        "frontend: ");
    request.ask(set_up_thread(radio.native_handle(), {realtime_.radio_priority, realtime_.radio_cpu}),
                "radio: ");
    request.log_refused();
    if (service_) service_->begin();
  }  // joined in the order of the data's way
  return pipeline_.outcome();
}

template <typename Work>
std::jthread Daemon::thread(const char* name, Work work) const {
  return std::jthread([name, work, touches_stack = realtime_.lock_memory] {
    pthread_setname_np(pthread_self(), name);
    if (touches_stack) prefault_stack();
    work();
  });
}

void Daemon::run_radio(const std::stop_token& stop) {
  RadioWorker& worker = pipeline_.radio_worker();
  while (!stop.stop_requested()) {
    const StepResult result = worker.step();
    if (result == StepResult::kFinished) break;
    if (result == StepResult::kProgress) continue;
    const MonotonicTime now = clock_.now();
    const bool until_due = result == StepResult::kIdle && worker.due() > now + kRoomWait;
    clock_.sleep_until(until_due ? std::min(worker.due(), now + kStopWait) : now + kRoomWait);
  }
  worker.end_input();
  input_is_over_ = true;
}

template <typename Worker>
void Daemon::run_to_end(Worker& worker) {
  while (true) {
    switch (worker.step()) {
      case StepResult::kProgress:
        break;
      case StepResult::kIdle:
        worker.wait();
        break;
      case StepResult::kBlocked:
        sleep_for(kRoomWait);
        break;
      case StepResult::kFinished:
        return;
    }
  }
}

void Daemon::run_publisher() {
  while (publisher_worker_.step() != StepResult::kFinished) {
    if (service_)
      service_->look(clock_.now(), {.radio_steps = pipeline_.radio_worker().steps(),
                                    .input_is_over = input_is_over_,
                                    .is_followed = is_followed_,
                                    .statuses = publisher_worker_.statuses(),
                                    .status = publisher_worker_.status()});
    const MonotonicTime next_tick = clock_.now() + PublisherWorker::kTick;
    while (publisher_worker_.wait_for_poses(clock_, next_tick)) publisher_worker_.publish_poses();
  }
}

}  // namespace swiftlet
