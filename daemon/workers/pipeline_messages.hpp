// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/backend/backend.hpp"
#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"
#include "daemon/system/clock.hpp"
#include "firmware_link/sample/input_counters.hpp"
#include "firmware_link/session/live_status.hpp"

namespace swiftlet {

/// The beams of one sample.
struct BeamReadings {
  /// Before the first sample: nothing is measured yet.
  static BeamReadings of(const BeamLayout& beams, const SensorModel& sensor) {
    BeamReadings out{.count = beams.count, .max_range_m = static_cast<float>(sensor.max_range_m)};
    for (std::size_t i = 0; i < beams.count; ++i)
      out.bearing_rad[i] = static_cast<float>(beams.bearing_rad[i]);
    out.status.fill(RangeStatus::kInvalid);
    return out;
  }

  std::uint8_t count = 0;
  float max_range_m = 0.0F;                    ///< SensorModel::max_range_m
  std::array<float, kMaxBeams> bearing_rad{};  ///< as in BeamLayout
  std::array<float, kMaxBeams> distance_m{};   ///< as in RangeSample
  std::array<RangeStatus, kMaxBeams> status{};
};

/// Where the vehicle is, in all three frames, and what it saw there; one for each sample.
struct PoseUpdate {
  HostTime stamp{};
  std::uint32_t sequence = 0;  ///< RangeSample::sequence
  std::uint32_t segment = 0;   ///< counts up each time the dead reckoning began anew; the first is 1
  KeyframeId keyframe{};       ///< the newest at the time
  std::uint32_t correction_version = 0;  ///< MapCorrection::version behind T_map_body; 0: none yet
  double correction_m = 0.0;             ///< by which that correction moved T_map_body
  Pose2 T_map_body{};
  Pose2 T_local_body{};
  Pose2 T_odom_body{};
  StoreyId storey{};
  Tracking tracking = Tracking::kTracking;
  Covariance3 from_start{};         ///< of T_map_body, as PoseConfidence's; zero before the first keyframe
  Covariance3 from_surroundings{};  ///< likewise
  DeviceTime measured_at{};         ///< RangeSample::measured_at
  BeamReadings beams{};
  MonotonicTime arrived_at{};  ///< ReceivedSample::arrived_at; of a recording, when the sample was due
};

/// How the input stands.
struct InputStatus {
  InputCounters counters;
  std::uint64_t problems = 0;  ///< how many InputReport holds
  double progress = -1.0;      ///< 0 to 1 through a recording; negative when the end is unknown
  bool ended = false;          ///< no further sample will come
  LiveStatus live{};           ///< condition kNone without a live link
};

/// A wall at its present place in the map.
struct WallInMap {
  LandmarkId id{};
  Point2 start_map{};
  Point2 end_map{};
  StoreyId storey{};
  bool is_gone = false;  ///< forgotten
};

/// A loop closure, when found and again when the final pass drops it.
struct ClosureUpdate {
  LoopClosure closure{};  ///< keyframes by their frontend ids
  Point2 from_map{};      ///< where the two keyframes stand now
  Point2 to_map{};
  StoreyId storey{};  ///< of both
};

static_assert(std::is_trivially_copyable_v<PoseUpdate> && std::is_trivially_copyable_v<InputStatus> &&
              std::is_trivially_copyable_v<WallInMap> && std::is_trivially_copyable_v<ClosureUpdate>);

}  // namespace swiftlet
