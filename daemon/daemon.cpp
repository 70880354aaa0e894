// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/daemon.hpp"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "daemon/backend_worker.hpp"
#include "daemon/frontend_worker.hpp"
#include "daemon/pipeline_queues.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

constexpr MonotonicTime::duration kRoomWait = milliseconds(1);   // before looking again at a full queue
constexpr MonotonicTime::duration kStopWait = milliseconds(20);  // the longest a stop goes unnoticed

/// A thread that carries `name` (at most 15 characters) and runs `work`.
template <typename Work>
std::jthread named_thread(const char* name, Work work) {
  return std::jthread([name, work] {
    pthread_setname_np(pthread_self(), name);
    work();
  });
}

}  // namespace

Daemon::Daemon(const Configuration& config, SampleSource& source, Clock& clock, const InputPolicy& policy,
               Publisher& publisher)
    : clock_(clock),
      pipeline_(config, source, clock, policy),
      publisher_worker_(config.publish, config.map.resolution_m, pipeline_.queues().to_publisher.inlet(),
                        {.queues = [this] { return pipeline_.queues().statistics(); },
                         .stages = [this] { return pipeline_.stage_times(); },
                         .pose_latency = pipeline_.pose_latency()},
                        publisher, clock) {}

Status Daemon::run(const std::stop_token& stop) {
  {
    const std::jthread publisher = named_thread("publisher", [this] { run_publisher(); });
    const std::jthread backend = named_thread("backend", [this] { run_to_end(pipeline_.backend_worker()); });
    const std::jthread frontend =
        named_thread("frontend", [this] { run_to_end(pipeline_.frontend_worker()); });
    const std::jthread radio = named_thread("radio", [this, &stop] { run_radio(stop); });
  }  // joined in the order of the data's way
  return pipeline_.outcome();
}

void Daemon::run_radio(const std::stop_token& stop) {
  RadioWorker& worker = pipeline_.radio_worker();
  while (!stop.stop_requested()) {
    const StepResult result = worker.step();
    if (result == StepResult::kFinished) return;
    if (result == StepResult::kProgress) continue;
    const MonotonicTime now = clock_.now();
    const bool until_due = result == StepResult::kIdle && worker.due() > now + kRoomWait;
    clock_.sleep_until(until_due ? std::min(worker.due(), now + kStopWait) : now + kRoomWait);
  }
  worker.end_input();
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
    const MonotonicTime next_tick = clock_.now() + PublisherWorker::kTick;
    while (publisher_worker_.wait_for_poses(clock_, next_tick)) publisher_worker_.publish_poses();
  }
}

}  // namespace swiftlet
