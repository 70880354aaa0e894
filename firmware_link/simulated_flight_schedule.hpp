// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulated_flight.hpp"

namespace swiftlet {

/// The states of one flight against a clock: it begins when told so, may be interrupted, in which case the
/// vehicle is held where it is, and goes on from there. Times are of any one clock, and never go back where
/// they are told. One thread at a time; allocates.
class FlightSchedule {
 public:
  /// Precondition: a flight has at least two states; kFlightStep lies between two.
  explicit FlightSchedule(std::vector<FlightState> states);

  /// Begins or goes on, unless it is going or over.
  void go(Duration now);
  /// Interrupts; without effect when it is not going.
  void halt(Duration now);

  [[nodiscard]] bool is_going() const { return !legs_.empty() && !legs_.back().until; }
  /// Since it last began or went on, whole steps of kFlightStep; false while it is not going.
  [[nodiscard]] bool is_at_step(Duration now) const;
  /// It came to its last state.
  [[nodiscard]] bool is_over(Duration at) const { return index(at) + 1 == states_.size(); }
  /// In the air, from its first state to its last.
  [[nodiscard]] Duration duration() const {
    return static_cast<std::int64_t>(states_.size() - 1) * kFlightStep;
  }
  /// 0 to 1.
  [[nodiscard]] double progress(Duration at) const;
  /// In the air so far.
  [[nodiscard]] Duration flown(Duration at) const {
    return static_cast<std::int64_t>(index(at)) * kFlightStep;
  }
  /// Now; at rest and on the ground while it is not going.
  [[nodiscard]] FlightState state(Duration now) const;
  /// At any time, between the steps too. A time still ahead is answered while the flight is going.
  [[nodiscard]] Pose2 T_world_body(Duration at) const;

 private:
  struct Leg {
    Duration from;
    std::size_t index;              // of the state at `from`
    std::optional<Duration> until;  // interrupted then
  };

  [[nodiscard]] std::size_t index(Duration at) const;
  [[nodiscard]] const Leg* leg_at(Duration at) const;

  std::vector<FlightState> states_;
  std::vector<Leg> legs_;
};

}  // namespace swiftlet
