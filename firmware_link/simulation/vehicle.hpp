// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/barometer.hpp"
#include "firmware_link/simulation/battery.hpp"
#include "firmware_link/simulation/console.hpp"
#include "firmware_link/simulation/flight_schedule.hpp"
#include "firmware_link/simulation/log.hpp"
#include "firmware_link/simulation/memories.hpp"
#include "firmware_link/simulation/odometry.hpp"
#include "firmware_link/simulation/params.hpp"
#include "firmware_link/simulation/ranger.hpp"
#include "firmware_link/simulation/steered_flight.hpp"
#include "firmware_link/simulation/tilt.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

enum class SimulatedDeck : std::uint8_t { kFlow, kMultiranger };

/// After that much silence the firmware gives up the radio link.
inline constexpr Duration kRadioLinkTimeout = std::chrono::seconds(1);

/// The errors of the sensors aboard, and the equipment of the vehicle.
struct VehicleModel {
  PilotModel pilot;
  FlowOdometryModel odometry;
  RangerModel ranger;
  TiltModel tilt;
  BarometerModel barometer;
  /// The Multiranger task reads all sensors once in a period and restarts each; a reading's light was
  /// gathered that long before it is published.
  Duration range_period = std::chrono::milliseconds(100);
  Duration range_age = std::chrono::milliseconds(78);
  Duration battery_endurance = std::chrono::minutes(8);  ///< in flight
  Duration clock_start = std::chrono::seconds(4);        ///< the vehicle's clock when the simulation begins
  /// After that long without a packet the vehicle deletes its log blocks; 0: never, as over its own cable.
  Duration link_timeout{0};
  bool has_flow_deck = true;
  bool has_multiranger = true;
  bool is_steered = false;        ///< flies by its client's hover setpoints, not its world's script
  bool prints_boot_text = false;  ///< the console text of its first boot waits for the first packet received
};

/// A packet that the vehicle sends of its own accord.
struct SentPacket {
  DeviceTime at{};
  PacketBytes bytes;
};

/// A Crazyflie with flow and Multiranger deck, seen through its radio: CRTP packets in, CRTP packets out;
/// time advances by advance() only. It stands on the ground until a log block runs, then flies its world's
/// script and lands; or it flies by setpoints. The same seed and calls give the same bytes. One thread at a
/// time; allocates.
class SimulatedVehicle {
 public:
  /// Noise sources: "pilot", "flow", "gyro", "slip", "yaw_jump", "tilt", "range_phase", "range_front" ..
  /// "range_up", "range_down", "range_alias", "battery", "baro", "baro_drift", "rssi", "boot",
  /// "log_jitter/<block>".
  SimulatedVehicle(SimulatedWorld world, const VehicleModel& model, std::uint64_t seed);

  /// The time of the simulation, which never goes back; the vehicle's clock shows the same until it reboots.
  [[nodiscard]] DeviceTime now() const { return DeviceTime(now_); }
  [[nodiscard]] const SimulatedWorld& world() const { return world_; }
  /// Of the flight, 0 to 1.
  [[nodiscard]] double progress() const { return flight_.progress(now_); }
  /// Whether it has landed again.
  [[nodiscard]] bool is_finished() const { return !steered_ && flight_.is_over(now_); }
  [[nodiscard]] bool is_flying() const { return is_on_air() && state_.is_flying; }
  /// The truth, of the last minute in the air (FlightSchedule::kRemembered). Before take-off the starting
  /// place, after landing the last. Once the flight has begun, times up to a minute ahead are known; until
  /// then they count as on the ground.
  [[nodiscard]] Pose2 T_world_body(DeviceTime at);

  /// Whether it answers at all (a radio gets acknowledgements): not while it boots, nor once its battery is
  /// empty, until reboot().
  [[nodiscard]] bool is_on_air() const { return !boots_at_ && !is_off_; }
  /// How often it discarded its transmit queue (silence, reboot). A radio that delays packets of this vehicle
  /// drops them when this changes.
  [[nodiscard]] unsigned flushes() const { return flushes_; }

  /// The answers to one packet, received at now().
  [[nodiscard]] std::vector<PacketBytes> handle(std::span<const std::uint8_t> packet);
  /// Advances to `to` and returns the packets sent meanwhile, in order. A time in the past has no effect.
  [[nodiscard]] std::vector<SentPacket> advance(DeviceTime to);

  // Faults.

  /// Silent for 2 to 4 s; its clock restarts near 0; log blocks and changed parameters are gone; an empty
  /// battery is replaced. A flight is interrupted, the vehicle held where it is; when a log block runs again
  /// it flies on from there, with a restarted estimate.
  void reboot();
  /// The filter finds its state out of bounds: the estimate jumps to kalman.initialX, initialY, initialYaw.
  void reset_estimator();
  /// A sensor hangs: all of range.* keep their values for that long.
  void freeze_ranges(Duration duration);
  /// The deck's values stay as they are; after the next reboot the deck is missing.
  void unplug(SimulatedDeck deck);

 private:
  using Milliseconds = std::chrono::milliseconds;
  struct Ranger {
    double bearing_rad;
    double VehicleState::*shown_mm;
    NoiseSource noise;
  };
  struct QueuedPacket {
    Milliseconds due;
    PacketBytes bytes;
  };

  [[nodiscard]] Milliseconds clock() const { return now_ - booted_at_; }
  [[nodiscard]] std::optional<PacketBytes> answer(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::optional<PacketBytes> answer_echo(std::span<const std::uint8_t> packet);
  [[nodiscard]] FlightState truth();
  [[nodiscard]] Duration flown() const { return steered_ ? steered_->flown() : flight_.flown(now_); }
  void tick();
  [[nodiscard]] std::vector<PacketBytes> send_due();
  void boot();
  void set_up_parameters();
  void print_boot_text();
  void flush();
  void check_link();
  void apply_parameters();
  void begin_estimate();
  [[nodiscard]] double bounded(std::uint16_t param) const;
  void move();
  void read_sensors();
  void read_rangers();
  [[nodiscard]] double filtered_range_mm(std::optional<double> range_m);
  void update_battery();
  void show(const FlightState& truth);

  SimulatedWorld world_;
  VehicleModel model_;
  FlightSchedule flight_;
  std::optional<SteeredFlight> steered_;
  FlowOdometry odometry_;
  SimulatedTilt tilt_;
  std::array<Ranger, 4> rangers_;
  NoiseSource up_noise_;
  NoiseSource down_noise_;
  NoiseSource alias_noise_;
  NoiseSource rssi_noise_;
  NoiseSource boot_noise_;
  SimulatedBarometer barometer_;
  SimulatedBattery battery_;
  SimulatedLog log_;
  SimulatedParams params_;
  SimulatedMemories memories_;
  SimulatedConsole console_;
  std::vector<QueuedPacket> queue_;
  VehicleState state_;
  Milliseconds now_;
  Milliseconds booted_at_{0};  // when the vehicle's clock was 0
  Milliseconds last_received_{0};
  Milliseconds next_range_read_;
  Milliseconds ranges_frozen_until_{0};
  std::optional<Milliseconds> boots_at_;
  bool is_off_ = false;
  bool is_linked_ = false;  // it has received a packet and the link has not timed out since
  unsigned flushes_ = 0;
};

}  // namespace swiftlet
