// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

constexpr int kTakeOffSteps = 200;
constexpr double kLookAheadM = 0.35;   // how far ahead of the vehicle the pilot aims
constexpr double kArrivedM = 0.1;      // near enough to a place with an action
constexpr double kYawGain = 2.0;       // 1/s
constexpr double kStairsClimb = 0.17;  // m/s, up or down

/// Where the ground rises or falls between two waypoints.
struct Ramp {
  Point2 foot;  // where it begins
  double direction_rad;
  double length_m;  // along the floor
  double rise_m;    // negative downwards

  [[nodiscard]] double risen_m(const Point2& at) const {
    const double along_m =
        (at.x_m - foot.x_m) * std::cos(direction_rad) + (at.y_m - foot.y_m) * std::sin(direction_rad);
    return rise_m * std::clamp(along_m / length_m, 0.0, 1.0);
  }
};

/// Stairs between two storeys, with a level landing of kArrivedM at either end: the ground does not jump
/// where the pilot turns to the next leg.
Ramp ramp_between(const Waypoint& from, const Waypoint& to, double storey_height_m) {
  const double direction_rad = bearing_rad(from.position, to.position);
  const Point2 foot{from.position.x_m + kArrivedM * std::cos(direction_rad),
                    from.position.y_m + kArrivedM * std::sin(direction_rad)};
  const double length_m = distance_m(from.position, to.position) - 2.0 * kArrivedM;
  return {foot, direction_rad, std::max(kArrivedM, length_m), storey_height_m * (to.storey - from.storey)};
}

}  // namespace

RepeatedScript::RepeatedScript(std::vector<Waypoint> script, int laps) : script_(std::move(script)) {
  SWIFTLET_CHECK(script_.size() >= 2 && laps >= 1, "a flight leads somewhere");
  const Waypoint& start = script_.front();
  const Waypoint& end = script_.back();
  const std::size_t legs = script_.size() - 1;
  const bool is_closed = start.position.x_m == end.position.x_m && start.position.y_m == end.position.y_m &&
                         start.storey == end.storey;
  period_ = is_closed ? legs : 2 * legs;
  size_ = 1 + legs + static_cast<std::size_t>(laps - 1) * period_;
}

Waypoint RepeatedScript::operator[](std::size_t i) const {
  if (i == 0) return script_.front();
  const std::size_t in_period = 1 + (i - 1) % period_;
  const std::size_t last = script_.size() - 1;
  if (in_period <= last) return script_[in_period];
  const Waypoint& passed = script_[2 * last - in_period];
  return {.position = passed.position, .storey = passed.storey};
}

SimulatedFlight::Wander::Wander(double sigma, double time_constant_s)
    : keep_(std::exp(-kFlightStepS / time_constant_s)), kick_(sigma * std::sqrt(1.0 - keep_ * keep_)) {}

SimulatedFlight::SimulatedFlight(const SimulatedWorld& world, const PilotModel& model, std::uint64_t seed)
    : script_(world.flight, model.laps),
      storey_height_m_(world.storey_height_m),
      model_(model),
      noise_(seed, "pilot"),
      wander_x_(model.wander_m, 4.0),
      wander_y_(model.wander_m, 4.0),
      wander_yaw_(model.wander_yaw_rad, 3.0),
      wander_speed_(model.wander_speed_share, 5.0),
      aim_(script_[0].position),
      nose_rad_(bearing_rad(aim_, script_[1].position)),
      motion_(Pose2(aim_.x_m, aim_.y_m, nose_rad_)) {
  motion_.set_ground(ground_m());
}

void SimulatedFlight::step() {
  if (take_off_steps_ < kTakeOffSteps) {
    hover(model_.height_m * ++take_off_steps_ / kTakeOffSteps);
  } else if (!arrived()) {
    follow_script();
  } else if (!is_over()) {
    hover(model_.height_m * --landing_steps_left_ / kLandingSteps);
  }
}

void SimulatedFlight::follow_script() {
  move_aim();
  if (spin_left_rad_ != 0.0) {
    look_around();
  } else {
    hover_left_s_ = std::max(0.0, hover_left_s_ - kFlightStepS);
    steer(wander_yaw_.step(noise_));
  }
  motion_.set_ground(ground_m());
}

bool SimulatedFlight::is_stairs(std::size_t leg) const {
  return leg < script_.size() && script_[leg - 1].storey != script_[leg].storey;
}

/// At what there is to do, at the ends of stairs and of the flight.
bool SimulatedFlight::stops_at_next() const {
  const Waypoint next = script_[next_];
  return next.spin_rad != 0.0 || next.hover_s != 0.0 || next_ + 1 == script_.size() || is_stairs(next_) ||
         is_stairs(next_ + 1);
}

double SimulatedFlight::ground_m() const {
  const Waypoint from = script_[next_ - 1];
  const double from_m = storey_height_m_ * from.storey;
  if (!is_stairs(next_)) return from_m;
  const Ramp ramp = ramp_between(from, script_[next_], storey_height_m_);
  return from_m + ramp.risen_m(motion_.state().T_world_body.position());
}

/// Slower where it would climb or sink faster than kStairsClimb.
double SimulatedFlight::cruise_m_s() const {
  if (!is_stairs(next_)) return model_.speed_m_s;
  const Ramp ramp = ramp_between(script_[next_ - 1], script_[next_], storey_height_m_);
  return std::min(model_.speed_m_s, kStairsClimb * ramp.length_m / std::abs(ramp.rise_m));
}

/// One step in place, at that height.
void SimulatedFlight::hover(double height_m) {
  motion_.set_height(height_m);
  motion_.step(0.0, 0.0, 0.0);
}

/// Keeps the aim kLookAheadM ahead on the scripted lines; at a spin it waits for the vehicle.
void SimulatedFlight::move_aim() {
  const Point2 here = motion_.state().T_world_body.position();
  while (!arrived() && spin_left_rad_ == 0.0 && hover_left_s_ == 0.0 &&
         distance_m(here, aim_) < kLookAheadM) {
    const Waypoint target = script_[next_];
    const double left_m = distance_m(aim_, target.position);
    if (left_m > 1e-9) {
      const double share = std::min(1.0, 0.01 / left_m);
      aim_.x_m += share * (target.position.x_m - aim_.x_m);
      aim_.y_m += share * (target.position.y_m - aim_.y_m);
      if (target.heading == PilotHeading::kIntoTravel)
        nose_rad_ = bearing_rad(script_[next_ - 1].position, target.position);
      continue;
    }
    if (stops_at_next() && distance_m(here, aim_) > kArrivedM) return;
    spin_left_rad_ = target.spin_rad;
    hover_left_s_ = target.hover_s;
    ++next_;
  }
}

void SimulatedFlight::look_around() {
  const double rate = std::copysign(model_.turn_rate_rad_s, spin_left_rad_);
  motion_.step(0.0, 0.0, rate);
  const double turned = motion_.state().yaw_rate_rad_s * kFlightStepS;
  spin_left_rad_ = std::abs(turned) >= std::abs(spin_left_rad_) ? 0.0 : spin_left_rad_ - turned;
  nose_rad_ = motion_.state().T_world_body.yaw_rad();
}

/// Towards the aim, slowly while the nose points elsewhere.
void SimulatedFlight::steer(double wander_yaw_rad) {
  const Point2 here = motion_.state().T_world_body.position();
  const Point2 aim{aim_.x_m + wander_x_.step(noise_), aim_.y_m + wander_y_.step(noise_)};
  const double nose_error = wrap_angle(nose_rad_ + wander_yaw_rad - motion_.state().T_world_body.yaw_rad());
  const double readiness = std::clamp(std::cos(nose_error), 0.1, 1.0);
  const double nearness = std::min(1.0, distance_m(here, aim) / kLookAheadM);
  const double speed = cruise_m_s() * readiness * nearness * (1.0 + wander_speed_.step(noise_));
  const double course = bearing_rad(here, aim);
  motion_.step(speed * std::cos(course), speed * std::sin(course),
               limited(kYawGain * nose_error, model_.turn_rate_rad_s));
}

}  // namespace swiftlet
