// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// The most beams one sample can carry (a Multiranger deck has 4; laser logs are thinned to fit).
inline constexpr std::size_t kMaxBeams = 64;

/// The most storeys of a building that are told apart.
inline constexpr std::size_t kMaxStoreys = 32;

enum class RangeStatus : std::uint8_t {
  kHit,       ///< distance_m is the distance to something
  kNoReturn,  ///< nothing within the sensor's range; distance_m is 0
  kInvalid,   ///< no measurement and no information; distance_m is 0
};

/// Ranges with the dead reckoning of the same time. Every input delivers these, and all of core works on
/// them. Trivially copyable: crosses queues by value.
struct RangeSample {
  std::uint32_t sequence = 0;  ///< counts up from 0 within a run
  DeviceTime measured_at{};  ///< when the ranges were measured: the packet's device time less the range's age
  HostTime stamp{};   ///< Unix time at which the packet holding the ranges was received (laser logs: the
                      ///< scan's own stamp, exactly as logged). Identifies the sample in all outputs.
  Pose2 T_odom_body;  ///< dead reckoning, interpolated to measured_at
  bool starts_segment =
      false;  ///< the dead reckoning does not continue from the sample before (first sample, reboot,
              ///< silence, estimator reset): the step between the two is not a measured motion
  bool odometry_ran_on = false;  ///< with starts_segment: the link was silent, but the vehicle's dead
                                 ///< reckoning ran on: the step is the best guess, over an unknown path
  StoreyId storey{};             ///< of the building, where the ranges were measured
  std::uint8_t beam_count = 0;   ///< beams in use; bearings are in the BeamLayout of the input
  std::array<float, kMaxBeams> distance_m{};  ///< horizontal, from body to the hit
  std::array<RangeStatus, kMaxBeams> status{};
};
static_assert(std::is_trivially_copyable_v<RangeSample>);

}  // namespace swiftlet
