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

/// One flight against a clock: go() begins it, halt() interrupts it and holds the vehicle where it is, go()
/// continues it. It is flown as far as it is queried, and its last minute in the air is remembered. All times
/// are of one clock; those passed to go(), halt() and state() never go back. One thread at a time; go()
/// allocates.
class FlightSchedule {
 public:
  /// How far back T_world_body() reaches, in the air.
  static constexpr Duration kRemembered = std::chrono::minutes(1);

  /// Flies a copy of the flight to measure its duration. Precondition: the flight has not begun. Allocates.
  explicit FlightSchedule(SimulatedFlight flight);

  /// Begins or continues, unless it is going or over.
  void go(Duration now);
  /// Interrupts; without effect when it is not going.
  void halt(Duration now);

  [[nodiscard]] bool is_going() const { return !legs_.empty() && !legs_.back().until; }
  /// Whether whole steps of kFlightStep have passed since it last began or continued; false while it is not
  /// going.
  [[nodiscard]] bool is_at_step(Duration now) const;
  /// Whether it has reached its last state.
  [[nodiscard]] bool is_over(Duration at) const { return index(at) == last_; }
  /// 0 to 1.
  [[nodiscard]] double progress(Duration at) const;
  /// In the air so far.
  [[nodiscard]] Duration flown(Duration at) const {
    return static_cast<std::int64_t>(index(at)) * kFlightStep;
  }
  /// At rest and on the ground while it is not going.
  [[nodiscard]] FlightState state(Duration now);
  /// Also between the steps. A time before the remembered ones counts as the first of them; while the flight
  /// is going, times up to kRemembered ahead are known.
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
  std::size_t newest_ = 0;           // index of the newest state flown
  std::size_t last_;                 // index of the state after landing
  std::vector<Leg> legs_;
};

}  // namespace swiftlet
