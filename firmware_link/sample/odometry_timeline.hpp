// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/time.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/flight_limits.hpp"
#include "firmware_link/sample/attitude.hpp"

namespace swiftlet {

/// Stamps of laser logs come in bunches, and are not those of the wheels.
inline constexpr double kWheelsJumpSlackM = 2.0;

/// When readings of dead reckoning belong to one motion.
struct ContinuityLimits {
  Duration longest_interpolation{};           ///< no value between readings further apart than this
  Duration longest_silence{};                 ///< after a longer one the dead reckoning counts as restarted
  double top_speed_m_per_s = kTopSpeedMPerS;  ///< what moves faster (and farther than the slack) was reset
  double jump_slack_m = 0.1;
  double top_turn_rate_rad_per_s = 4.0 * kPi;
  /// From where the dead reckoning began; what is farther away is an error of it.
  double farthest_m = std::numeric_limits<double>::infinity();
  /// Between readings that far apart lies a pause: what the vehicle did there is a guess.
  Duration unwatched_after = Duration::max();
};

struct YawReading {
  double yaw_rad = 0.0;
};

struct HeightReading {
  double height_m = 0.0;
};

inline Point2 interpolate(const Point2& a, const Point2& b, double fraction) {
  return {a.x_m + fraction * (b.x_m - a.x_m), a.y_m + fraction * (b.y_m - a.y_m)};
}
inline HeightReading interpolate(const HeightReading& a, const HeightReading& b, double fraction) {
  return {a.height_m + fraction * (b.height_m - a.height_m)};
}
inline BodyTilt interpolate(const BodyTilt& a, const BodyTilt& b, double fraction) {
  return {a.x_up + fraction * (b.x_up - a.x_up), a.y_up + fraction * (b.y_up - a.y_up)};
}
/// The shorter of both ways around the circle.
inline YawReading interpolate(const YawReading& a, const YawReading& b, double fraction) {
  return {wrap_angle(a.yaw_rad + fraction * wrap_angle(b.yaw_rad - a.yaw_rad))};
}
/// Whether a motion can lead from one to the other within `elapsed`.
inline bool is_motion(const Point2& a, const Point2& b, Duration elapsed, const ContinuityLimits& limits) {
  return distance_m(a, b) <= limits.jump_slack_m + limits.top_speed_m_per_s * to_seconds(elapsed);
}
inline bool is_motion(const YawReading& a, const YawReading& b, Duration elapsed,
                      const ContinuityLimits& limits) {
  return std::abs(wrap_angle(b.yaw_rad - a.yaw_rad)) <= limits.top_turn_rate_rad_per_s * to_seconds(elapsed);
}

/// The ground below may step, and a body may turn over: no step of these is too wide.
inline bool is_motion(const HeightReading&, const HeightReading&, Duration, const ContinuityLimits&) {
  return true;
}
inline bool is_motion(const BodyTilt&, const BodyTilt&, Duration, const ContinuityLimits&) { return true; }

/// The latest readings of one part of the dead reckoning (position, yaw, tilt or height), interpolated in
/// time. Fixed storage: the oldest reading is overwritten. One thread at a time.
template <typename Value, std::size_t kCapacity = 128>
class OdometryTimeline {
 public:
  enum class Outcome {
    kFound,
    kTooEarly,  ///< nothing received yet at or after that time: try again later
    kHole,      ///< between readings that are too far apart
    kNever,     ///< a jump, or before the oldest reading
  };
  struct Answer {
    Outcome outcome = Outcome::kNever;
    Value value{};
    /// Counts the restarts of the dead reckoning: values of equal runs are joined by motion.
    std::uint32_t run = 0;
    std::uint32_t pauses = 0;  ///< so far
  };

  explicit OdometryTimeline(const ContinuityLimits& limits) : limits_(limits) {}

  void set_limits(const ContinuityLimits& limits) { limits_ = limits; }
  /// Readings not later than the newest are ignored. Returns whether the step from there is too wide for a
  /// motion.
  bool add(DeviceTime at, const Value& value) {
    bool is_leap = false;
    if (count_ > 0) {
      const Reading& last = newest();
      if (at <= last.at) return false;
      const Duration elapsed = at - last.at;
      const bool is_silence = elapsed > limits_.longest_silence;
      is_leap = !is_silence && !is_motion(last.value, value, elapsed, limits_);
      if (is_silence || is_leap) ++run_;
      if (elapsed >= limits_.unwatched_after) ++pauses_;
    }
    readings_[(first_ + count_) % kCapacity] = {at, value, run_, pauses_};
    if (count_ < kCapacity) {
      ++count_;
    } else {
      first_ = (first_ + 1) % kCapacity;
    }
    return is_leap;
  }
  /// Clears all readings; what follows is a new run.
  void restart() {
    count_ = 0;
    ++run_;
  }

  /// Whether readings come, up to `latest`, often enough for a value between the newest and the next.
  [[nodiscard]] bool goes_on(DeviceTime latest) const {
    if (count_ < 2) return false;
    return newest().at - reading(count_ - 2).at <= limits_.longest_interpolation &&
           latest - newest().at <= limits_.longest_interpolation;
  }

  [[nodiscard]] Answer at(DeviceTime time) const {
    if (count_ == 0 || newest().at < time) return {Outcome::kTooEarly, {}, run_};
    for (std::size_t i = count_; i > 0; --i) {
      const Reading& before = reading(i - 1);
      if (before.at > time) continue;
      if (before.at == time) return {Outcome::kFound, before.value, before.run, before.pauses};
      const Reading& after = reading(i);
      const Duration hole = after.at - before.at;
      if (before.run != after.run) return {};
      if (hole > limits_.longest_interpolation) return {Outcome::kHole, {}, before.run};
      const double fraction = to_seconds(time - before.at) / to_seconds(hole);
      return {Outcome::kFound, interpolate(before.value, after.value, fraction), before.run, before.pauses};
    }
    return {};
  }

 private:
  struct Reading {
    DeviceTime at{};
    Value value{};
    std::uint32_t run = 0;
    std::uint32_t pauses = 0;
  };
  [[nodiscard]] const Reading& reading(std::size_t i) const { return readings_[(first_ + i) % kCapacity]; }
  [[nodiscard]] const Reading& newest() const { return reading(count_ - 1); }

  ContinuityLimits limits_;
  std::array<Reading, kCapacity> readings_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint32_t run_ = 0;
  std::uint32_t pauses_ = 0;
};

}  // namespace swiftlet
