// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/base/result.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/publish/publisher_worker.hpp"
#include "daemon/publish/service_watch.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/radio_worker.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// The pipeline in threads: radio, frontend, backend and publisher, each with its worker and its name.
class Daemon {
 public:
  /// References must outlive the daemon. Precondition: config.validate() is empty.
  Daemon(const Configuration& config, SampleSource& source, Clock& clock, const InputPolicy& policy,
         Publisher& publisher);

  /// As Pipeline::keep_pruned(). Before run().
  void keep_pruned(PrunedScans& pruned) { pipeline_.keep_pruned(pruned); }
  /// As Pipeline::execute_commands_by(). Before run().
  void execute_commands_by(CommandHandler handler) { pipeline_.execute_commands_by(std::move(handler)); }
  /// As Pipeline::command(), also while run() does.
  [[nodiscard]] bool command(const Command& command) { return pipeline_.command(command); }
  /// As Pipeline::execute_commands(). Not while run() does.
  void execute_late_commands() { pipeline_.execute_commands(); }
  /// Whether another program uses the vehicle over this link. Any thread.
  [[nodiscard]] bool has_client() const { return pipeline_.has_client(); }
  /// Another run follows: the service manager is not told that the daemon stops. Any thread.
  void announce_next_run() { is_followed_ = true; }
  /// What the status has of the run's recording: called in the publisher's thread while run() does. Before
  /// run().
  void report_recording(std::function<RecordingFigures()> recording) { recording_ = std::move(recording); }
  /// Readiness, progress and the end are reported to the service manager, if there is one. Before run(); must
  /// outlive the daemon.
  void report_to(const ServiceManager& manager) { service_.emplace(manager, clock_.now()); }

  /// Runs until the input ends or `stop` is requested; then what has been taken in is worked off, the final
  /// pass runs and everything is published. Call once. Errors: whatever ended the input before its time.
  [[nodiscard]] Status run(const std::stop_token& stop);

  /// Not while run() does.
  [[nodiscard]] const Pipeline& pipeline() const { return pipeline_; }

 private:
  RealtimeConfig realtime_;
  Clock& clock_;
  Pipeline pipeline_;
  std::function<RecordingFigures()> recording_ = [] { return RecordingFigures{}; };
  PublisherWorker publisher_worker_;
  std::optional<ServiceWatch> service_;
  std::atomic<bool> input_is_over_{false};
  std::atomic<bool> is_followed_{false};

  /// A thread that carries `name` (at most 15 characters) and runs `work`.
  template <typename Work>
  std::jthread thread(const char* name, Work work) const;
  void run_radio(const std::stop_token& stop);
  template <typename Worker>
  void run_to_end(Worker& worker);
  void run_publisher();
  void sleep_for(Duration duration) { clock_.sleep_until(clock_.now() + duration); }
};

}  // namespace swiftlet
