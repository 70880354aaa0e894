// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet {
namespace {

constexpr double kTakeOffAndLandingS = 4.0;
constexpr double kSlowingS = 0.2;            // at each corner, besides the turn
constexpr double kTurnedInPassingRad = 0.4;  // costs no time
constexpr double kSeenWithinM = 2.5;         // of a place that was flown through
constexpr double kRoomM = 0.5;               // a place to stay at

/// How often the pilot does what, drawn for a flight.
struct FlightStyle {
  double revisit = 0.3;    // share of the legs that lead to a place seen before
  double retrace = 0.15;   // ... back the way it came
  double hover = 0.15;     // of the corners
  double spin = 0.12;      // of the corners
  double sidestep = 0.08;  // of the lines between corners
  double reverse = 0.06;
  double avoid_flown = 0.5;  // of the legs: another way where there is one, so that loops close
  bool returns = true;       // ends where it began
};

FlightStyle draw_style(NoiseSource& noise) {
  return {.revisit = noise.uniform(0.2, 0.6),
          .retrace = noise.uniform(0.0, 0.25),
          .hover = noise.uniform(0.0, 0.25),
          .spin = noise.uniform(0.0, 0.25),
          .sidestep = noise.uniform(0.0, 0.15),
          .reverse = noise.uniform(0.0, 0.12),
          .avoid_flown = noise.uniform(0.3, 1.0),
          .returns = noise.chance(0.8)};
}

class FlightWriter {
 public:
  FlightWriter(FreeSpaceGrid& grid, const PilotModel& pilot, double duration_s, NoiseSource& noise)
      : grid_(grid),
        pilot_(pilot),
        left_s_(duration_s - kTakeOffAndLandingS),
        noise_(noise),
        style_(draw_style(noise)) {}

  std::vector<Waypoint> write();

 private:
  [[nodiscard]] Point2 any_place();
  [[nodiscard]] Point2 new_place();
  [[nodiscard]] Point2 old_place();
  [[nodiscard]] bool is_time_to_return() const;
  void fly_to(const Point2& place);
  void retrace();
  void fly_line(const Point2& to);
  void act_at_corner();
  void add(const Waypoint& waypoint);
  [[nodiscard]] const Point2& here() const { return flight_.back().position; }

  FreeSpaceGrid& grid_;
  PilotModel pilot_;
  double left_s_;
  NoiseSource& noise_;
  FlightStyle style_;
  std::vector<Waypoint> flight_;
  double nose_rad_ = 0.0;
};

Point2 FlightWriter::any_place() {
  const auto& places = grid_.places();
  Point2 place = places.front();
  for (int i = 0; i < 30; ++i) {
    place = places[static_cast<std::size_t>(whole_between(noise_, 0, static_cast<int>(places.size()) - 1))];
    if (grid_.clearance_m(place) > kRoomM) break;
  }
  return place;
}

/// Of some, the one farthest from where it has been, and not too far from here.
Point2 FlightWriter::new_place() {
  Point2 best = here();
  double best_score = -1e9;
  for (int i = 0; i < 12; ++i) {
    const Point2 place = any_place();
    double unseen_m = 8.0;
    for (std::size_t k = 1; k < flight_.size(); ++k)
      unseen_m = std::min(unseen_m, distance_m({flight_[k - 1].position, flight_[k].position}, place));
    const double score = unseen_m - 0.15 * distance_m(here(), place);
    if (score > best_score) best = place;
    best_score = std::max(best_score, score);
  }
  return best;
}

Point2 FlightWriter::old_place() {
  const int last = static_cast<int>(flight_.size()) - 1;
  for (int i = 0; i < 8; ++i) {
    const Point2& place = flight_[static_cast<std::size_t>(whole_between(noise_, 0, last))].position;
    if (distance_m(place, here()) > kSeenWithinM) return place;
  }
  return flight_.front().position;
}

bool FlightWriter::is_time_to_return() const {
  const double back_s = 1.6 * distance_m(here(), flight_.front().position) / pilot_.speed_m_s;
  return style_.returns && left_s_ < back_s + 5.0;
}

std::vector<Waypoint> FlightWriter::write() {
  flight_.push_back({any_place()});
  for (int legs = 0; left_s_ > 0.0 && legs < 500; ++legs) {
    if (flight_.size() > 3 && is_time_to_return()) {
      fly_to(flight_.front().position);
      break;
    }
    if (flight_.size() > 3 && noise_.chance(style_.retrace))
      retrace();
    else
      fly_to(flight_.size() > 3 && noise_.chance(style_.revisit) ? old_place() : new_place());
  }
  return std::move(flight_);
}

void FlightWriter::fly_to(const Point2& place) {
  const auto corners = grid_.route(here(), place, noise_.chance(style_.avoid_flown));
  if (!corners) return;
  for (std::size_t i = 1; i < corners->size() && left_s_ > 0.0; ++i) fly_line((*corners)[i]);
}

/// Back over some of the last corners, now and then tail first.
void FlightWriter::retrace() {
  const std::size_t from = flight_.size() - 1;
  const auto legs = static_cast<std::size_t>(whole_between(noise_, 1, 6));
  const bool is_tail_first = noise_.chance(0.4);
  for (std::size_t i = 1; i <= std::min(legs, from) && left_s_ > 0.0; ++i)
    add({flight_[from - i].position,
         is_tail_first && i < 3 ? PilotHeading::kKeep : PilotHeading::kIntoTravel});
}

/// Now and then after a turn on the spot, so that the line is flown sideways or backwards.
void FlightWriter::fly_line(const Point2& to) {
  act_at_corner();
  const double length_m = distance_m(here(), to);
  const double fate = noise_.uniform(0.0, 1.0);
  const bool is_short = length_m > 0.5 && length_m < 6.0 && flight_.size() > 1;
  if (!is_short || fate > style_.sidestep + style_.reverse) {
    add({to});
    return;
  }
  const double nose = bearing_rad(here(), to) + (fate < style_.reverse ? kPi : noise_.either_sign(kPi / 2.0));
  flight_.back().spin_rad = wrap_angle(nose - nose_rad_);
  left_s_ -= std::abs(flight_.back().spin_rad) / pilot_.turn_rate_rad_s;
  nose_rad_ = nose;
  add({to, PilotHeading::kKeep});
}

void FlightWriter::act_at_corner() {
  if (flight_.size() < 2) return;
  Waypoint& corner = flight_.back();
  if (noise_.chance(style_.hover)) corner.hover_s = noise_.uniform(0.5, 6.0);
  if (noise_.chance(style_.spin)) corner.spin_rad = noise_.either_sign(noise_.uniform(0.5, 2.0 * kPi));
  nose_rad_ += corner.spin_rad;
  left_s_ -= corner.hover_s + std::abs(corner.spin_rad) / pilot_.turn_rate_rad_s;
}

void FlightWriter::add(const Waypoint& waypoint) {
  const double length_m = distance_m(here(), waypoint.position);
  if (length_m < 0.05) return;
  left_s_ -= length_m / pilot_.speed_m_s + kSlowingS;
  if (waypoint.heading == PilotHeading::kIntoTravel) {
    const double nose = bearing_rad(here(), waypoint.position);
    const double turn_rad = std::abs(wrap_angle(nose - nose_rad_));
    left_s_ -= std::max(0.0, turn_rad - kTurnedInPassingRad) / pilot_.turn_rate_rad_s;
    nose_rad_ = nose;
  }
  grid_.mark_flown(here(), waypoint.position);
  flight_.push_back(waypoint);
}

}  // namespace

PilotModel drawn_pilot(std::uint64_t seed) {
  NoiseSource noise(seed, "building_pilot");
  PilotModel pilot;
  pilot.speed_m_s = noise.uniform(0.3, 0.7);
  pilot.turn_rate_rad_s = radians(noise.uniform(40.0, 90.0));
  pilot.height_m = noise.uniform(0.35, 0.9);
  pilot.wander_m = noise.uniform(0.01, 0.04);
  pilot.wander_yaw_rad = radians(noise.uniform(1.0, 5.0));
  pilot.wander_speed_share = noise.uniform(0.02, 0.15);
  return pilot;
}

std::vector<Waypoint> draw_flight(FreeSpaceGrid& grid, const PilotModel& pilot, double duration_s,
                                  NoiseSource& noise) {
  return FlightWriter(grid, pilot, duration_s, noise).write();
}

}  // namespace swiftlet
