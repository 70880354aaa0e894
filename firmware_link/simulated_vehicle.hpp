// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulated_flight.hpp"
#include "firmware_link/simulated_log.hpp"
#include "firmware_link/simulated_odometry.hpp"
#include "firmware_link/simulated_ranger.hpp"
#include "firmware_link/simulated_world.hpp"

namespace swiftlet {

/// How everything aboard errs.
struct VehicleModel {
  PilotModel pilot;
  FlowOdometryModel odometry;
  RangerModel ranger;
  /// The Multiranger task reads all sensors once in a period and restarts each; a reading's light was
  /// gathered that long before it is published.
  Duration range_period = std::chrono::milliseconds(100);
  Duration range_age = std::chrono::milliseconds(78);
};

/// A packet that the vehicle sends of its own accord.
struct SentPacket {
  DeviceTime at{};
  PacketBytes bytes;
};

/// A Crazyflie with flow and Multiranger deck as its radio shows it: CRTP packets in, CRTP packets out, time
/// only as it is told. It stands on the ground until a log block runs, then flies its world's script once and
/// lands. The same seed and calls give the same bytes. One thread at a time; allocates.
class SimulatedVehicle {
 public:
  /// Noise sources: "pilot", "flow", "gyro", "slip", "range_phase", "range_front" .. "range_up",
  /// "range_down", "battery", "rssi", "log_jitter/<block>".
  SimulatedVehicle(SimulatedWorld world, const VehicleModel& model, std::uint64_t seed);

  /// How far the vehicle's clock has come; it begins a few seconds after booting.
  [[nodiscard]] DeviceTime now() const { return DeviceTime(now_); }
  /// Of the flight, 0 to 1.
  [[nodiscard]] double progress() const;
  /// It has landed again.
  [[nodiscard]] bool is_finished() const;
  /// The truth. Before take-off the starting place, after landing the last. A time still ahead is answered
  /// once the flight has begun; until then it is taken for the ground.
  [[nodiscard]] Pose2 T_world_body(DeviceTime at) const;

  /// The answers to one packet, heard at now().
  [[nodiscard]] std::vector<PacketBytes> handle(std::span<const std::uint8_t> packet);
  /// Lives on until `to` and returns what was sent meanwhile, in order. A time already past does nothing.
  [[nodiscard]] std::vector<SentPacket> advance(DeviceTime to);

 private:
  using Milliseconds = std::chrono::milliseconds;
  struct Ranger {
    double bearing_rad;
    double VehicleState::*shown_mm;
    NoiseSource noise;
  };

  void tick();
  void fly_on();
  void read_rangers();
  void update_battery();
  void show(const FlightState& truth);
  [[nodiscard]] std::size_t flight_index(Duration since_boot) const;

  SimulatedWorld world_;
  VehicleModel model_;
  std::vector<FlightState> flight_;
  FlowOdometry odometry_;
  std::array<Ranger, 4> rangers_;
  NoiseSource up_noise_;
  NoiseSource down_noise_;
  NoiseSource battery_noise_;
  NoiseSource rssi_noise_;
  SimulatedLog log_;
  VehicleState state_;
  Milliseconds now_;
  Milliseconds next_range_read_;
  std::optional<Milliseconds> took_off_at_;
};

}  // namespace swiftlet
