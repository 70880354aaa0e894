// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/workers/worker.hpp"

namespace swiftlet {

/// Publishes what the other workers hand over, and keeps a copy of the map's tiles and walls to send them
/// again for late joiners. Poses go first and at once, all else when its tick comes. One thread at a time;
/// may allocate; never holds up the others.
class PublisherWorker {
 public:
  /// Call step() this often.
  static constexpr std::chrono::milliseconds kTick{4};
  /// At most this many tiles leave in one step (17 kB, 4 MB/s): a receiver with the kernel's default socket
  /// buffer keeps up.
  static constexpr std::size_t kTilesPerStep = 4;
  /// The last status is sent this often, since a datagram may be lost.
  static constexpr int kFinalStatuses = 3;

  /// Sources of figures of the status, called in the publisher's thread, and a sink: the latency of poses.
  struct Gauges {
    std::function<std::array<QueueStatistics, 7>()> queues;
    std::function<std::vector<StageSummary>()> stages;
    PoseLatency& pose_latency;
    std::function<RecordingFigures()> recording = [] { return RecordingFigures{}; };
  };

  /// References must outlive the worker.
  PublisherWorker(const PublishConfig& config, double resolution_m, const PublisherInlet& inlet,
                  Gauges gauges, Publisher& publisher, const Clock& clock);

  /// One tick's worth. kIdle: call again after kTick. kFinished: all is sent, also the final status.
  StepResult step();
  /// Sleeps until poses wait, which publish_poses() sends at once, or until `wake_at`. Whether any wait.
  [[nodiscard]] bool wait_for_poses(Clock& clock, MonotonicTime wake_at) const {
    return inlet_.poses.wait_until(clock, wake_at);
  }
  void publish_poses();
  /// The newest that was published, and how many were.
  [[nodiscard]] const DaemonStatus& status() const { return status_; }
  [[nodiscard]] std::uint64_t statuses() const { return statuses_; }

 private:
  PublishConfig config_;
  double resolution_m_;
  PublisherInlet inlet_;
  Gauges gauges_;
  Publisher& publisher_;
  const Clock& clock_;

  HostTime now_{};  // stamp of the newest pose
  DaemonStatus status_;
  /// A tile from which everything was rubbed out is kept and sent like the others: consumers must learn of
  /// it.
  struct KeptTile {
    MapTile tile;
    bool holds_anything = false;
  };
  std::map<TileIndex, KeptTile> tiles_;
  std::map<LandmarkId, WallInMap> walls_;
  std::uint64_t version_sum_ = 0;

  MonotonicTime last_step_;
  MonotonicTime last_summary_;
  std::uint64_t statuses_ = 0;
  std::uint64_t poses_since_summary_ = 0;
  double refresh_due_ = 0.0;    // tiles to be sent again by now
  TileIndex last_refreshed_{};  // round-robin in the order of the index
  bool is_closing_ = false;     // everything has come; all tiles are being sent a last time
  std::size_t final_tiles_left_ = 0;
  int final_statuses_left_ = kFinalStatuses;

  void take_walls();
  void take_closures();
  void take_events();
  void take_counters();
  /// How many were taken and published.
  [[nodiscard]] std::size_t take_tiles();
  void keep(const MapTile& tile);
  void refresh_tiles(std::size_t at_most, MonotonicTime now);
  void refresh_next_tile();
  void publish_summary(MonotonicTime now);
  [[nodiscard]] MapSummary map_summary() const;
  StepResult close(MonotonicTime now);
};

}  // namespace swiftlet
