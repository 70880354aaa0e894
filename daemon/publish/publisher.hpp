// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/frontend/frontend.hpp"
#include "core/mapping/map_tile.hpp"
#include "daemon/workers/pipeline_messages.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/stage_times.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

/// The map as a whole, so that a consumer can lay out its tiles and check that it has them all.
struct MapSummary {
  double resolution_m = 0.0;
  std::uint32_t tiles = 0;
  /// Over all tiles: equal to a consumer's own sum when it has the newest of each.
  std::uint64_t version_sum = 0;
  TileIndex lowest{};  ///< corners of the tiles' bounding box; both (0, 0) while there are none
  TileIndex highest{};
};

enum class DaemonState : std::uint8_t {
  kRunning,    ///< samples are being taken
  kFinishing,  ///< the input has ended; what is left is worked off and the final pass runs
  kFinished,   ///< every tile has been sent again; nothing more will come
};

/// A live link's traffic since the status before.
struct LinkRates {
  double ack_rate = -1.0;           ///< of the packets sent; negative: none was
  double retries_per_packet = 0.0;  ///< retransmissions by the dongle
  double sent_hz = 0.0;
  double received_hz = 0.0;  ///< packets with content
};

enum class RecordingState : std::uint8_t {
  kNone,     ///< the run is not recorded
  kRunning,  ///< it is
  kFailed,   ///< the recording has ended before its time
};
struct RecordingFigures {
  RecordingState state = RecordingState::kNone;
  std::uint64_t bytes = 0;  ///< of all its files so far
};

/// The content of a status message.
struct DaemonStatus {
  DaemonState state = DaemonState::kRunning;
  double sample_rate_hz = 0.0;  ///< samples published per second of the machine's time since the last status
  InputStatus input;
  LinkRates link_rates;
  FrontendCounters frontend;
  BackendCounters backend;
  TrackingFigures tracking;
  std::array<QueueStatistics, 7> queues;
  std::vector<StageSummary> stages;
  std::uint64_t missed_deadlines = 0;  ///< RunTiming::missed_deadlines
  RecordingFigures recording;
  MapSummary map;
};

/// Publishes what the daemon estimates. `now` is the stamp of the newest sample behind a message: Unix time
/// in the data's own time line, so that a replay at any rate publishes the same. What a publisher does not
/// override it does not publish. One thread at a time (the publisher's).
class Publisher {
 public:
  Publisher() = default;
  virtual ~Publisher() = default;
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  virtual void publish_pose(const PoseUpdate& /*pose*/) {}
  virtual void publish_tile(HostTime /*now*/, const MapTile& /*tile*/, double /*resolution_m*/) {}
  virtual void publish_map(HostTime /*now*/, const MapSummary& /*map*/) {}
  /// All walls, in the order of their ids.
  virtual void publish_walls(HostTime /*now*/, std::span<const WallInMap> /*walls*/) {}
  virtual void publish_closure(HostTime /*now*/, const ClosureUpdate& /*closure*/) {}
  /// One that the user should act on.
  virtual void publish_event(HostTime /*now*/, const VehicleEvent& /*event*/) {}
  virtual void publish_status(HostTime /*now*/, const DaemonStatus& /*status*/) {}
};

}  // namespace swiftlet
