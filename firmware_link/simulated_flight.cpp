// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/check.hpp"
#include "firmware_link/simulated_random.hpp"

namespace swiftlet {
namespace {

constexpr double kStepS = std::chrono::duration<double>(kFlightStep).count();
constexpr int kTakeOffSteps = 200;
constexpr int kLandingSteps = 200;
constexpr double kLookAheadM = 0.35;         // how far ahead of the vehicle the pilot aims
constexpr double kArrivedM = 0.1;            // near enough to a place where there is something to do
constexpr double kVelocityResponseS = 0.3;   // velocity follows the stick with this time constant
constexpr double kMaxAcceleration = 1.2;     // m/s^2
constexpr double kYawGain = 2.0;             // 1/s
constexpr double kMaxYawAcceleration = 4.0;  // rad/s^2

double limited(double value, double magnitude) { return std::clamp(value, -magnitude, magnitude); }

/// A mean-reverting random walk (Ornstein-Uhlenbeck), exact for a fixed step.
class Wander {
 public:
  Wander(double sigma, double time_constant_s)
      : keep_(std::exp(-kStepS / time_constant_s)), kick_(sigma * std::sqrt(1.0 - keep_ * keep_)) {}
  double step(NoiseSource& noise) { return value_ = keep_ * value_ + noise.gaussian(kick_); }

 private:
  double keep_;
  double kick_;
  double value_ = 0.0;
};

/// The script over and over: from its end on, or back along it where it does not end where it began.
std::vector<Waypoint> repeated(const std::vector<Waypoint>& script, int laps) {
  std::vector<Waypoint> flight = script;
  const Point2 start = script.front().position;
  const Point2 end = script.back().position;
  const bool is_closed = start.x_m == end.x_m && start.y_m == end.y_m;
  for (int lap = 1; lap < laps; ++lap) {
    if (!is_closed)
      for (std::size_t i = script.size() - 1; i-- > 0;) flight.push_back({script[i].position});
    flight.insert(flight.end(), script.begin() + 1, script.end());
  }
  return flight;
}

class Pilot {
 public:
  Pilot(const SimulatedWorld& world, const PilotModel& model, std::uint64_t seed)
      : flight_(repeated(world.flight, model.laps)),
        model_(model),
        noise_(seed, "pilot"),
        wander_speed_(model.wander_speed_share, 5.0) {
    SWIFTLET_CHECK(flight_.size() >= 2, "a flight leads somewhere");
    aim_ = flight_.front().position;
    nose_rad_ = bearing(aim_, flight_[1].position);
    state_.T_world_body = Pose2(aim_.x_m, aim_.y_m, nose_rad_);
  }

  [[nodiscard]] const FlightState& state() const { return state_; }
  [[nodiscard]] bool arrived() const { return next_ == flight_.size(); }

  /// One step along the script.
  void step() {
    move_aim();
    if (spin_left_rad_ != 0.0) {
      look_around();
    } else {
      steer(wander_yaw_.step(noise_));
    }
  }
  /// One step in place, at that height.
  void hover(double height_m) {
    state_.height_m = height_m;
    apply(0.0, 0.0, 0.0);
  }

 private:
  static double bearing(const Point2& from, const Point2& to) {
    return std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  }
  static double distance_m(const Point2& a, const Point2& b) {
    return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  }

  /// Keeps the aim kLookAheadM ahead on the scripted lines; at a spin it waits for the vehicle.
  void move_aim() {
    const Point2 here = state_.T_world_body.position();
    while (!arrived() && spin_left_rad_ == 0.0 && distance_m(here, aim_) < kLookAheadM) {
      const Waypoint& target = flight_[next_];
      const double left_m = distance_m(aim_, target.position);
      if (left_m > 1e-9) {
        const double share = std::min(1.0, 0.01 / left_m);
        aim_.x_m += share * (target.position.x_m - aim_.x_m);
        aim_.y_m += share * (target.position.y_m - aim_.y_m);
        if (target.heading == PilotHeading::kIntoTravel)
          nose_rad_ = bearing(flight_[next_ - 1].position, target.position);
        continue;
      }
      const bool stops_here = target.spin_rad != 0.0 || next_ + 1 == flight_.size();
      if (stops_here && distance_m(here, aim_) > kArrivedM) return;
      spin_left_rad_ = target.spin_rad;
      ++next_;
    }
  }

  void look_around() {
    const double rate = std::copysign(model_.turn_rate_rad_s, spin_left_rad_);
    apply(0.0, 0.0, rate);
    const double turned = state_.yaw_rate_rad_s * kStepS;
    spin_left_rad_ = std::abs(turned) >= std::abs(spin_left_rad_) ? 0.0 : spin_left_rad_ - turned;
    nose_rad_ = state_.T_world_body.yaw_rad();
  }

  /// Towards the aim, slowly while the nose is still elsewhere.
  void steer(double wander_yaw_rad) {
    const Point2 here = state_.T_world_body.position();
    const Point2 aim{aim_.x_m + wander_x_.step(noise_), aim_.y_m + wander_y_.step(noise_)};
    const double nose_error = wrap_angle(nose_rad_ + wander_yaw_rad - state_.T_world_body.yaw_rad());
    const double readiness = std::clamp(std::cos(nose_error), 0.1, 1.0);
    const double nearness = std::min(1.0, distance_m(here, aim) / kLookAheadM);
    const double speed = model_.speed_m_s * readiness * nearness * (1.0 + wander_speed_.step(noise_));
    const double course = bearing(here, aim);
    apply(speed * std::cos(course), speed * std::sin(course),
          limited(kYawGain * nose_error, model_.turn_rate_rad_s));
  }

  /// Lets the vehicle follow the commanded velocity (world frame) and yaw rate for one step.
  void apply(double vx_m_s, double vy_m_s, double yaw_rate_rad_s) {
    double ax = (vx_m_s - vx_m_s_) / kVelocityResponseS;
    double ay = (vy_m_s - vy_m_s_) / kVelocityResponseS;
    const double excess = std::hypot(ax, ay) / kMaxAcceleration;
    if (excess > 1.0) {
      ax /= excess;
      ay /= excess;
    }
    vx_m_s_ += ax * kStepS;
    vy_m_s_ += ay * kStepS;
    state_.yaw_rate_rad_s += limited(yaw_rate_rad_s - state_.yaw_rate_rad_s, kMaxYawAcceleration * kStepS);
    const Pose2& was = state_.T_world_body;
    state_.T_world_body = Pose2(was.x_m() + vx_m_s_ * kStepS, was.y_m() + vy_m_s_ * kStepS,
                                was.yaw_rad() + state_.yaw_rate_rad_s * kStepS);
    const double c = state_.T_world_body.cos_yaw();
    const double s = state_.T_world_body.sin_yaw();
    state_.vx_body_m_s = c * vx_m_s_ + s * vy_m_s_;
    state_.vy_body_m_s = -s * vx_m_s_ + c * vy_m_s_;
    state_.ax_body_m_s2 = c * ax + s * ay;
    state_.ay_body_m_s2 = -s * ax + c * ay;
  }

  std::vector<Waypoint> flight_;
  PilotModel model_;
  NoiseSource noise_;
  Wander wander_x_{model_.wander_m, 4.0};
  Wander wander_y_{model_.wander_m, 4.0};
  Wander wander_yaw_{model_.wander_yaw_rad, 3.0};
  Wander wander_speed_;
  FlightState state_;
  Point2 aim_;             // where the pilot steers to, on the scripted lines
  std::size_t next_ = 1;   // the waypoint that the aim moves towards
  double nose_rad_ = 0.0;  // where the nose should point
  double spin_left_rad_ = 0.0;
  double vx_m_s_ = 0.0;  // in the world frame
  double vy_m_s_ = 0.0;
};

}  // namespace

std::vector<FlightState> fly(const SimulatedWorld& world, const PilotModel& model, std::uint64_t seed) {
  Pilot pilot(world, model, seed);
  std::vector<FlightState> states{pilot.state()};
  for (int i = 1; i <= kTakeOffSteps; ++i) {
    pilot.hover(model.height_m * i / kTakeOffSteps);
    states.push_back(pilot.state());
  }
  while (!pilot.arrived()) {
    pilot.step();
    states.push_back(pilot.state());
  }
  for (int i = kLandingSteps - 1; i >= 0; --i) {
    pilot.hover(model.height_m * i / kLandingSteps);
    states.push_back(pilot.state());
  }
  return states;
}

}  // namespace swiftlet
