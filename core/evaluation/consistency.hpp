// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/time.hpp"
#include "core/evaluation/known_place_error.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "core/geometry/covariance3.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A pose with its doubt, as it was published.
struct DoubtedPose {
  HostTime stamp{};
  double path_m = 0.0;  ///< travelled since the start of the run
  Pose2 T_map_body;
  Covariance3 from_start;           ///< of (x, y, yaw) relative to the start, along the axes of frame map
  bool is_tracked = false;          ///< the program held the pose for right
  Covariance3 from_surroundings{};  ///< as from_start, relative to the part of the map around the vehicle
  std::string_view state{};         ///< its name; of the program's life
};

/// The error of one pose against its covariance.
struct ConsistencyAt {
  double path_m = 0.0;  ///< travelled since the start
  double nees = 0.0;    ///< normalised estimation error squared: 3 on average where the covariance is right
  double error_m = 0.0;
  double sigma_m = 0.0;  ///< of the position, both axes together
  double error_yaw_rad = 0.0;
  double sigma_yaw_rad = 0.0;
};

inline constexpr std::array<double, 3> kConsistencyDistancesM{10.0, 20.0, 60.0};

/// The first pose with a true one after each of the distances, nothing where the run is shorter. The first of
/// all is the start. Bar-Shalom, Li, Kirubarajan 2001, "Estimation with applications
/// to tracking and navigation", section 5.4.
[[nodiscard]] std::array<std::optional<ConsistencyAt>, kConsistencyDistancesM.size()> consistency(
    std::span<const DoubtedPose> poses, const StampedPath& T_world_body);

struct AlarmTuning {
  double right_m = 0.5;  ///< a pose off by less is right
  double off_m = 1.0;    ///< a pose off by more is to be noticed
  double grace_s = 5.0;  ///< an alarm is right if the pose was off so long before it
};

/// The states of a run against its errors at known places.
struct AlarmCounts {
  double seconds = 0.0;
  double seconds_doubted = 0.0;
  std::size_t alarms = 0;
  std::size_t false_alarms = 0;     ///< of those: the pose was right all the time
  std::size_t unjudged_alarms = 0;  ///< of those: no place was known, nobody can tell
  std::size_t times_off = 0;        ///< that the error passed AlarmTuning::off_m at a known place
  std::vector<double> noticed_s{};  ///< after how long each of those was noticed; without those that were not
                                    ///< before the pose was right again or the run ended
};
/// Both in order of time.
[[nodiscard]] AlarmCounts count_alarms(std::span<const DoubtedPose> poses,
                                       std::span<const StampedError> errors, const AlarmTuning& tuning = {});

}  // namespace swiftlet
