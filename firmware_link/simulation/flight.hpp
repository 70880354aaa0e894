// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/random.hpp"
#include "firmware_link/simulation/vehicle_motion.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

inline constexpr int kMaxLaps = 1000;

/// How a flight is flown. The wandering terms are standard deviations of slow, mean-reverting deviations from
/// the script.
struct PilotModel {
  double speed_m_s = 0.5;
  double turn_rate_rad_s = radians(60.0);  ///< at most
  double height_m = 0.5;
  double wander_m = 0.04;
  double wander_yaw_rad = radians(3.0);
  double wander_speed_share = 0.06;  ///< of the speed
  int laps = 1;                      ///< how often the script is flown before landing
};

/// A script that is repeated without being stored more than once: from its end on, or back along it if it
/// does not end where it began.
class RepeatedScript {
 public:
  /// Precondition: a script of at least two waypoints, at least one lap. Allocates.
  RepeatedScript(std::vector<Waypoint> script, int laps);

  /// Waypoints of all laps.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Waypoint operator[](std::size_t i) const;
  /// How often the script is flown from one end to the other, in either direction.
  [[nodiscard]] int passes() const { return static_cast<int>((size_ - 1) / (script_.size() - 1)); }

 private:
  std::vector<Waypoint> script_;
  std::size_t period_ = 0;  // waypoints after which the script repeats
  std::size_t size_ = 0;
};

/// The flight through a world's script from take-off to landing, flown step by step, in memory that does not
/// grow with its length. It stops at both ends of stairs and flies them at a moderate climb, at its height
/// above the steps. A copy continues the same flight. Noise source: "pilot". One thread at a time; step()
/// allocates nothing.
class SimulatedFlight {
 public:
  /// On the ground, in the first state. Allocates.
  SimulatedFlight(const SimulatedWorld& world, const PilotModel& pilot, std::uint64_t seed);

  [[nodiscard]] const FlightState& state() const { return motion_.state(); }
  /// Whether it has landed: this is the last state.
  [[nodiscard]] bool is_over() const { return landing_steps_left_ == 0; }
  /// Advances to the state kFlightStep later; the last one stays.
  void step();

 private:
  /// A mean-reverting random walk (Ornstein-Uhlenbeck), exact for a fixed step.
  class Wander {
   public:
    Wander(double sigma, double time_constant_s);
    double step(NoiseSource& noise) { return value_ = keep_ * value_ + noise.gaussian(kick_); }

   private:
    double keep_;
    double kick_;
    double value_ = 0.0;
  };
  static constexpr int kLandingSteps = 200;

  [[nodiscard]] bool arrived() const { return next_ == script_.size(); }
  [[nodiscard]] bool is_stairs(std::size_t leg) const;
  [[nodiscard]] bool stops_at_next() const;
  [[nodiscard]] double ground_m() const;
  [[nodiscard]] double cruise_m_s() const;
  void follow_script();
  void hover(double height_m);
  void move_aim();
  void look_around();
  void steer(double wander_yaw_rad);

  RepeatedScript script_;
  double storey_height_m_;
  PilotModel model_;
  NoiseSource noise_;
  Wander wander_x_;
  Wander wander_y_;
  Wander wander_yaw_;
  Wander wander_speed_;
  int take_off_steps_ = 0;
  int landing_steps_left_ = kLandingSteps;
  Point2 aim_;            // the point on the scripted lines that the pilot steers to
  std::size_t next_ = 1;  // the waypoint that the aim moves towards
  double nose_rad_;       // where the nose should point
  double spin_left_rad_ = 0.0;
  double hover_left_s_ = 0.0;
  VehicleMotion motion_;
};

}  // namespace swiftlet
