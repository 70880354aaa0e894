// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_flight_schedule.hpp"

#include <algorithm>
#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {

FlightSchedule::FlightSchedule(std::vector<FlightState> states) : states_(std::move(states)) {
  SWIFTLET_CHECK(states_.size() >= 2, "a flight has a beginning and an end");
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
  return static_cast<double>(index(at)) / static_cast<double>(states_.size() - 1);
}

FlightState FlightSchedule::state(Duration now) const {
  if (is_going()) return states_[index(now)];
  return {.T_world_body = states_[index(now)].T_world_body};
}

Pose2 FlightSchedule::T_world_body(Duration at) const {
  const std::size_t i = index(at);
  const Pose2& before = states_[i].T_world_body;
  const Leg* const leg = leg_at(at);
  if (leg == nullptr || i + 1 == states_.size() || (leg->until && at >= *leg->until)) return before;
  const Pose2& after = states_[i + 1].T_world_body;
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
  return std::min(leg->index + static_cast<std::size_t>(flown / kFlightStep), states_.size() - 1);
}

/// The latest that had begun.
const FlightSchedule::Leg* FlightSchedule::leg_at(Duration at) const {
  const auto later = std::ranges::find_if(legs_, [at](const Leg& leg) { return leg.from >= at; });
  return later == legs_.begin() ? nullptr : &*std::prev(later);
}

}  // namespace swiftlet
