// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/simulation/vehicle_motion.hpp"

namespace swiftlet {

/// What a client wants the vehicle to do.
struct HoverSetpoint {
  double vx_body_m_s = 0.0;
  double vy_body_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;
  double height_m = 0.0;  ///< 0: on the ground, motors off
};

/// A generic setpoint (port 7, channel 0) of type hover, in either version, or stop; nullopt: another one,
/// which the simulation does not fly.
[[nodiscard]] std::optional<HoverSetpoint> read_setpoint(std::span<const std::uint8_t> packet);
/// As a client sends it.
[[nodiscard]] CrtpPacket hover_packet(const HoverSetpoint& setpoint);

/// A flight by a client's setpoints. Without any for kHoverAfter the vehicle stops in the air, after
/// kLandAfter it comes down, as by the firmware's watchdog. One thread at a time; allocates.
class SteeredFlight {
 public:
  static constexpr Duration kHoverAfter = std::chrono::milliseconds(500);
  static constexpr Duration kLandAfter = std::chrono::seconds(2);
  /// How far back T_world_body() reaches.
  static constexpr Duration kRemembered = std::chrono::seconds(1);

  /// On the ground.
  SteeredFlight(const Pose2& T_world_body, Duration now);

  void take(const HoverSetpoint& setpoint, Duration now);
  /// Flies on until `now` in steps of kFlightStep.
  void advance(Duration now);
  [[nodiscard]] const FlightState& state() const { return motion_.state(); }
  /// In the air so far.
  [[nodiscard]] Duration flown() const { return flown_; }
  /// Between the steps, too; a time before the remembered ones counts as the first of them.
  [[nodiscard]] Pose2 T_world_body(Duration at) const;

 private:
  void step();

  VehicleMotion motion_;
  HoverSetpoint setpoint_;
  Duration set_at_;
  Duration now_;
  Duration flown_{0};
  std::deque<Pose2> recent_;  // the last one at now_
};

}  // namespace swiftlet
