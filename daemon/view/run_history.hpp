// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/ids.hpp"
#include "core/mapping/map_tile.hpp"
#include "daemon/view/as_of_list.hpp"

namespace swiftlet {

// Times are utime of docs/lcm.md: microseconds since 1970 on the time line of the data.

/// A pose as the page draws it; m, rad.
struct TrailPose {
  std::int64_t utime_us = 0;
  std::uint32_t serial = 0;  ///< counts up from 1 in the run; some may be missing
  std::int32_t sequence = 0;
  std::int32_t segment = 0;
  std::int32_t correction_version = 0;
  std::int8_t storey = 0;              ///< as in pose_t
  std::int8_t tracking = 0;            ///< pose_t::TRACKING_...
  std::array<double, 6> covariance{};  ///< of map, relative to the part of the map around; as in pose_t
  std::array<double, 3> map{};         ///< x, y, yaw in frame map
  std::array<double, 3> local{};       ///< in frame local
  std::array<double, 3> odom{};        ///< in frame odom
  bool has_local = false;
  bool has_odom = false;
  /// m, along each of RunHistory::bearings_rad(), from the body to what was hit; 0: no return, negative: no
  /// measurement. Empty: unknown.
  std::vector<float> ranges_m{};

  [[nodiscard]] bool is_whole() const { return has_local && has_odom; }
};

struct SeenWall {
  std::int32_t id = 0;
  std::array<float, 2> start{};  ///< m, frame map
  std::array<float, 2> end{};
  std::int8_t storey = 0;  ///< as in pose_t
  bool operator==(const SeenWall&) const = default;
};

/// A loop closure, and until when it was believed.
struct SeenClosure {
  std::int32_t index = 0;
  std::int64_t found_us = 0;
  std::int64_t dropped_us = 0;  ///< 0: it still is
  std::int32_t from_keyframe = 0;
  std::int32_t to_keyframe = 0;
  std::array<double, 2> from_map{};  ///< m
  std::array<double, 2> to_map{};
  std::int8_t storey = 0;  ///< as in pose_t, of both
  double score = 0.0;
};

/// What a status says of the state of the run.
struct RunStatus {
  std::int64_t utime_us = 0;
  std::int8_t state = 0;   ///< status_t::STATE_...
  double progress = -1.0;  ///< 0 to 1 through a recording; negative: unknown
  double sample_rate_hz = 0.0;
  std::int64_t samples = 0;
  std::int64_t gaps = 0;
  std::int64_t missing_packets = 0;
  std::int64_t segments = 0;
  std::int64_t keyframes = 0;
  std::int64_t closures = 0;  ///< accepted and not dropped
  std::int64_t missed_deadlines = 0;
  double latency_p99_ms = -1.0;    ///< from radio frame to published pose; negative: unknown
  std::int8_t link_condition = 0;  ///< link_status_t::CONDITION_...
  double ack_rate = -1.0;          ///< 0 to 1; negative: unknown
  double round_trip_ms = -1.0;     ///< negative: unknown
  std::int32_t rssi_dbm = 0;       ///< 0: unknown
  double battery_v = 0.0;          ///< 0: unknown
  std::int8_t flying = -1;         ///< 1, 0, or -1: unknown
  std::int8_t recording = 0;       ///< status_t::RECORDING_...
  std::int64_t recorded_bytes = 0;
  std::int32_t tile_count = 0;
  std::int64_t version_sum = 0;
};

enum class EventLevel : std::uint8_t { kNote, kGood, kWarning, kBad };

/// Something that happened, in words.
struct RunEvent {
  std::uint32_t serial = 0;  ///< counts up from 1 in the run
  std::int64_t utime_us = 0;
  EventLevel level = EventLevel::kNote;
  std::string text;
};

/// A tile's content at some time, compressed.
struct StoredTile {
  std::uint32_t version = 0;
  std::vector<std::uint8_t> deflated;
};

/// How much is kept. What would be more is thinned, the older half first.
struct HistoryLimits {
  std::size_t poses = 60'000;
  std::size_t ranges = 2'000'000;  ///< over all poses
  std::size_t statuses = 20'000;
  std::size_t wall_segments = 2'000'000;  ///< over all times
  std::size_t tile_bytes = 256'000'000;   ///< compressed, over all times
  std::size_t events = 2'000;
  std::size_t closures = 20'000;
  std::int64_t tile_spacing_us = 400'000;  ///< of two versions of a tile that are both kept
  std::size_t tiles = 60'000;              ///< others are refused: a map of 0.6 km2 at 5 cm
};

/// All that a viewer may want to see of the newest run: how it is, and how it was. Begins anew with a new
/// run. Its memory is bounded. One thread at a time.
class RunHistory {
 public:
  explicit RunHistory(const HistoryLimits& limits = {}) : limits_(limits) {}

  /// To be called with the run that a message names, before the message is added. False: the message is of
  /// an older run and must not be added. A run that began earlier is believed when the present one has been
  /// silent for `silence_s`.
  [[nodiscard]] bool enter_run(std::int64_t map_id, double silence_s);

  /// With the pose in frame map; a serial is given. One before that is not whole by now is forgotten.
  void add_pose(TrailPose pose);
  /// Frames local and odom of the same sequence; ignored where that is not the newest pose.
  void add_local(std::int32_t sequence, const std::array<double, 3>& local);
  void add_odom(std::int32_t sequence, const std::array<double, 3>& odom);
  /// Likewise, TrailPose::ranges_m. Ignored, too, where the bearings are not those of the run's first ranges.
  void add_ranges(std::int32_t sequence, const std::vector<float>& bearings_rad, std::vector<float> ranges_m);
  /// Ignored unless the version is above the newest.
  void add_tile(std::int64_t utime_us, const MapTile& tile, double resolution_m);
  /// All walls.
  void add_walls(std::int64_t utime_us, const std::vector<SeenWall>& walls);
  void add_closure(const SeenClosure& closure, bool is_dropped, std::int64_t utime_us);
  void add_status(const RunStatus& status);
  void add_event(std::int64_t utime_us, EventLevel level, std::string text);

  /// Counts runs up; 0 before the first.
  [[nodiscard]] std::uint32_t generation() const { return generation_; }
  [[nodiscard]] std::int64_t map_id() const { return map_id_; }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  /// Counts every change up, over all runs.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  /// Of the beams, in the body frame; empty while there are no ranges.
  [[nodiscard]] const std::vector<float>& bearings_rad() const { return bearings_rad_; }
  /// Of the newest pose that is not after `at_us`; unset: of the newest. The first where there is none.
  [[nodiscard]] StoreyId storey_at(std::optional<std::int64_t> at_us) const;
  /// Of that storey, as of that moment.
  [[nodiscard]] std::vector<SeenWall> walls_at(std::optional<std::int64_t> at_us, StoreyId storey) const;
  /// Whether the map is final, by the newest status that is not after `at_us`; unset: by the newest.
  [[nodiscard]] bool is_finished_at(std::optional<std::int64_t> at_us) const;
  /// Each in all its frames: the newest is there once both others have come.
  [[nodiscard]] std::span<const TrailPose> poses_after(std::uint32_t serial) const;
  /// Those of the events after `serial`, oldest first.
  [[nodiscard]] std::span<const RunEvent> events_after(std::uint32_t serial) const;
  /// By index, each with the number of the change that it was last part of.
  struct NumberedClosure {
    SeenClosure closure;
    std::uint64_t change = 0;
  };
  [[nodiscard]] const std::map<std::int32_t, NumberedClosure>& closures() const { return closures_; }
  [[nodiscard]] const AsOfList<RunStatus>& statuses() const { return statuses_; }
  [[nodiscard]] const AsOfList<std::vector<SeenWall>>& walls() const { return walls_; }
  using Tiles = std::map<TileIndex, AsOfList<StoredTile>>;
  [[nodiscard]] const Tiles& tiles() const { return tiles_; }
  [[nodiscard]] std::size_t tile_bytes() const { return tile_bytes_; }

 private:
  HistoryLimits limits_;
  std::uint32_t generation_ = 0;
  std::int64_t map_id_ = 0;
  double resolution_m_ = 0.0;
  std::uint64_t changes_ = 0;
  std::vector<TrailPose> poses_;
  std::vector<float> bearings_rad_;
  std::size_t ranges_ = 0;  // of all poses
  std::uint32_t pose_serial_ = 0;
  std::vector<RunEvent> events_;
  std::uint32_t event_serial_ = 0;
  std::map<std::int32_t, NumberedClosure> closures_;
  AsOfList<RunStatus> statuses_;
  AsOfList<std::vector<SeenWall>> walls_;
  std::size_t wall_segments_ = 0;
  Tiles tiles_;
  std::size_t tile_bytes_ = 0;

  void begin_run(std::int64_t map_id);
  void drop_newest_unless_whole();
  void thin_poses();
  void thin_ranges();
  void thin_tiles();
};

/// The content of a stored tile; all cells unknown when `deflated` is none of ours.
[[nodiscard]] std::array<std::int8_t, kCellsInTile> inflate_tile(std::span<const std::uint8_t> deflated);

}  // namespace swiftlet
