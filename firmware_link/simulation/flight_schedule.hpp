// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/flight.hpp"

namespace swiftlet {

/// One flight against a clock: it begins when told so, may be interrupted, in which case the vehicle is held
/// where it is, and goes on from there. It is flown as far as it is asked for, and its last minute in the air
/// is remembered. Times are of any one clock, and never go back where they are told. One thread at a time;
/// go() allocates.
class FlightSchedule {
 public:
  /// How far back T_world_body() reaches, in the air.
  static constexpr Duration kRemembered = std::chrono::minutes(1);

  /// Flies the flight once to know how long it takes. Precondition: it has not begun. Allocates.
  explicit FlightSchedule(SimulatedFlight flight);

  /// Begins or goes on, unless it is going or over.
  void go(Duration now);
  /// Interrupts; without effect when it is not going.
  void halt(Duration now);

  [[nodiscard]] bool is_going() const { return !legs_.empty() && !legs_.back().until; }
  /// Since it last began or went on, whole steps of kFlightStep; false while it is not going.
  [[nodiscard]] bool is_at_step(Duration now) const;
  /// It came to its last state.
  [[nodiscard]] bool is_over(Duration at) const { return index(at) == last_; }
  /// 0 to 1.
  [[nodiscard]] double progress(Duration at) const;
  /// In the air so far.
  [[nodiscard]] Duration flown(Duration at) const {
    return static_cast<std::int64_t>(index(at)) * kFlightStep;
  }
  /// Now; at rest and on the ground while it is not going.
  [[nodiscard]] FlightState state(Duration now);
  /// Between the steps too. A time before the remembered ones is taken for the first of them; one that is up
  /// to kRemembered ahead is answered while the flight is going.
  [[nodiscard]] Pose2 T_world_body(Duration at);

 private:
  struct Leg {
    Duration from;
    std::size_t index;              // of the state at `from`
    std::optional<Duration> until;  // interrupted then
  };

  [[nodiscard]] std::size_t index(Duration at) const;
  [[nodiscard]] const Leg* leg_at(Duration at) const;
  [[nodiscard]] const FlightState& state_at(std::size_t index);

  SimulatedFlight flight_;
  std::vector<FlightState> recent_;  // the state of index i at i modulo its size
  std::size_t newest_ = 0;           // index of the state that the flight has come to
  std::size_t last_;                 // index of the state after landing
  std::vector<Leg> legs_;
};

}  // namespace swiftlet
