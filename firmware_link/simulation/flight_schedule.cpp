// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/flight_schedule.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
namespace {

std::size_t steps_of(SimulatedFlight flight) {
  std::size_t steps = 0;
  for (; !flight.is_over(); ++steps) flight.step();
  return steps;
}

}  // namespace

/// Room for twice the remembered time: a look ahead must not overwrite the past.
FlightSchedule::FlightSchedule(SimulatedFlight flight)
    : flight_(std::move(flight)),
      recent_(static_cast<std::size_t>(2 * kRemembered / kFlightStep)),
      last_(steps_of(flight_)) {
  recent_[0] = flight_.state();
}

void FlightSchedule::go(Duration now) {
  if (!is_going() && !is_over(now)) legs_.push_back({now, index(now), std::nullopt});
}

void FlightSchedule::halt(Duration now) {
  if (is_going()) legs_.back().until = now;
}

bool FlightSchedule::is_at_step(Duration now) const {
  return is_going() && (now - legs_.back().from) % kFlightStep == Duration(0);
}

double FlightSchedule::progress(Duration at) const {
  return static_cast<double>(index(at)) / static_cast<double>(last_);
}

FlightState FlightSchedule::state(Duration now) {
  const FlightState& state = state_at(index(now));
  if (is_going()) return state;
  return {.T_world_body = state.T_world_body, .ground_m = state.ground_m};
}

Pose2 FlightSchedule::T_world_body(Duration at) {
  const std::size_t i = index(at);
  const Pose2 before = state_at(i).T_world_body;
  const Leg* const leg = leg_at(at);
  if (leg == nullptr || i == last_ || (leg->until && at >= *leg->until)) return before;
  const Pose2 after = state_at(i + 1).T_world_body;
  const Duration past = at - leg->from - static_cast<std::int64_t>(i - leg->index) * kFlightStep;
  const double share = to_seconds(past) / to_seconds(kFlightStep);
  return {before.x_m() + share * (after.x_m() - before.x_m()),
          before.y_m() + share * (after.y_m() - before.y_m()),
          before.yaw_rad() + share * wrap_angle(after.yaw_rad() - before.yaw_rad())};
}

std::size_t FlightSchedule::index(Duration at) const {
  const Leg* const leg = leg_at(at);
  if (leg == nullptr) return 0;
  const Duration flown = std::min(at, leg->until.value_or(at)) - leg->from;
  return std::min(leg->index + static_cast<std::size_t>(flown / kFlightStep), last_);
}

/// Flies on to that state; the oldest remembered one, if it is older.
const FlightState& FlightSchedule::state_at(std::size_t index) {
  while (newest_ < index) {
    flight_.step();
    recent_[++newest_ % recent_.size()] = flight_.state();
  }
  const std::size_t oldest = newest_ < recent_.size() ? 0 : newest_ + 1 - recent_.size();
  return recent_[std::max(index, oldest) % recent_.size()];
}

/// The latest leg that had begun.
const FlightSchedule::Leg* FlightSchedule::leg_at(Duration at) const {
  const auto later = std::ranges::find_if(legs_, [at](const Leg& leg) { return leg.from >= at; });
  return later == legs_.begin() ? nullptr : &*std::prev(later);
}

}  // namespace swiftlet
