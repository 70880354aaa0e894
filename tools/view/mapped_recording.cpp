// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/view/mapped_recording.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "core/base/check.hpp"
#include "daemon/publish/lcm_publisher.hpp"
#include "daemon/publish/publisher_worker.hpp"
#include "daemon/view/message_reader.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/radio_worker.hpp"

namespace swiftlet {
namespace {

/// The moment of the data that has been mapped: what is due each second comes with each second of the run.
class DataClock final : public Clock {
 public:
  void advance_to(std::int64_t utime_us) {
    if (first_us_ == 0) first_us_ = utime_us;
    now_ = MonotonicTime(std::chrono::microseconds(utime_us - first_us_));
  }
  [[nodiscard]] MonotonicTime now() const override { return now_; }
  void sleep_until(MonotonicTime /*wake_at*/) override { SWIFTLET_CHECK(false, "nobody waits for the data"); }
  void wait_for(EventCount& /*event_count*/, std::uint32_t /*received*/, MonotonicTime wake_at) override {
    sleep_until(wake_at);
  }

 private:
  std::int64_t first_us_ = 0;
  MonotonicTime now_{};
};

/// The pipeline and a publisher's worker in lockstep.
class RecordingRun {
 public:
  RecordingRun(PreparedRun& run, SharedRunHistory& shared)
      : shared_(shared),
        reader_(shared.history),
        pipeline_(run.config, *run.source, wall_clock_, InputPolicy{}),
        publisher_(make_message_publisher(
            [this](const std::string& channel, std::span<const std::uint8_t> message) {
              take(channel, message);
              return true;
            },
            "", new_map_id())),
        worker_(run.config.publish, run.config.map.resolution_m, pipeline_.queues().to_publisher.inlet(),
                {.queues = [this] { return pipeline_.queues().statistics(); },
                 .stages = [] { return std::vector<StageSummary>(); },
                 .pose_latency = unused_latency_},
                *publisher_, data_clock_) {}

  Status run(const std::stop_token& stop, const RecordingWatch& watch) {
    if (watch.pruned != nullptr) pipeline_.keep_pruned(*watch.pruned);
    constexpr int kPublisherSteps = 4;  // of some tiles each: more than a sample changes
    Result<bool> more = true;
    while (more && *more && !stop.stop_requested()) {
      more = pipeline_.step();
      for (int i = 0; i < kPublisherSteps; ++i) worker_.step();
      if (watch.after_sample) watch.after_sample();
    }
    while (!stop.stop_requested() && worker_.step() != StepResult::kFinished) {
    }
    if (watch.at_end)
      if (Status told = watch.at_end(pipeline_.backend()); !told) return told;
    return more ? Status() : Status(more.error());
  }

 private:
  SharedRunHistory& shared_;
  MessageReader reader_;
  SteadyClock wall_clock_;
  DataClock data_clock_;
  PoseLatency unused_latency_{Duration::max()};
  Pipeline pipeline_;
  std::unique_ptr<Publisher> publisher_;
  PublisherWorker worker_;

  static std::int64_t new_map_id() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  }
  void take(const std::string& channel, std::span<const std::uint8_t> message) {
    const std::lock_guard lock(shared_.mutex);
    reader_.take(channel, message, wall_clock_.now());
    const auto poses = shared_.history.poses_after(0);
    if (!poses.empty()) data_clock_.advance_to(poses.back().utime_us);
  }
};

}  // namespace

Status map_recording(PreparedRun& run, SharedRunHistory& shared, const std::stop_token& stop,
                     const RecordingWatch& watch) {
  return std::make_unique<RecordingRun>(run, shared)->run(stop, watch);
}

}  // namespace swiftlet
