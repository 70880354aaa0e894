// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/simulation/random.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {

/// Where on the air a radio is. The vehicle's factory setting.
struct AirSetting {
  int channel = 80;
  RadioRate rate = RadioRate::k2Mbps;
  std::array<std::uint8_t, 5> address{0xE7, 0xE7, 0xE7, 0xE7, 0xE7};
  bool operator==(const AirSetting&) const = default;
};

/// Shares of transmissions that do not arrive.
struct AirLosses {
  double packet = 0.0;
  double ack = 0.0;
  /// The dongle's retransmissions meet the fate of the first try: a share of the exchanges fails, whatever
  /// the number of retransmissions.
  bool retries_share_fate = false;
};

/// What the dongle got out of sending one packet.
struct AirExchange {
  bool acked = false;
  int retries = 0;
  PacketBytes payload;  ///< of the ACK
  Duration duration{};
};

/// The radio chip (nRF51) of a simulated vehicle: addressing, safelink, queues, losses on the air. Time is
/// an argument. One thread at a time; allocates. Noise sources: "air_packet", "air_ack".
class EmulatedReceiver {
 public:
  static constexpr std::size_t kRadioQueue = 8;      ///< packets waiting in the radio chip...
  static constexpr std::size_t kVehicleQueue = 200;  ///< ...and behind it

  AirSetting setting;
  AirLosses losses;
  bool in_range = true;
  /// As firmware before 2026-05: of two safelink requests in a row the second gets no echo, and a packet that
  /// waits behind an echo is lost.
  bool old_firmware = false;

  /// The vehicle must outlive it.
  EmulatedReceiver(SimulatedVehicle& vehicle, std::uint64_t seed);

  /// The dongle sends `packet`, and again up to `retransmissions` times until it receives an ACK.
  [[nodiscard]] AirExchange exchange(const AirSetting& dongle, std::span<const std::uint8_t> packet,
                                     int retransmissions);
  /// The vehicle lives on. With it the chip restarts, and stays silent while the vehicle boots.
  void advance(Duration by);

  [[nodiscard]] bool safelink() const { return safelink_; }
  /// Every log data packet that found room in the queues and was not thrown away with them, as the vehicle
  /// made it: what a client must receive, once each.
  [[nodiscard]] const std::vector<SentPacket>& queued_log() const { return queued_log_; }
  /// Every packet that reached the vehicle, null packets left out.
  [[nodiscard]] const std::vector<PacketBytes>& uplink() const { return uplink_; }
  /// Packets of the vehicle that found no room or were thrown away with the queues.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  [[nodiscard]] PacketBytes on_frame(std::span<const std::uint8_t> packet);
  [[nodiscard]] PacketBytes echo_safelink_request(std::span<const std::uint8_t> packet);
  void settle_last();
  [[nodiscard]] PacketBytes next_downlink();
  void accept(std::span<const std::uint8_t> packet);
  bool queue(const PacketBytes& packet);
  void refill_radio_queue();
  void follow_vehicle();
  void throw_away(std::deque<PacketBytes>& queue);

  enum class Sent { kIdle, kQueued, kEcho };

  SimulatedVehicle& vehicle_;
  NoiseSource packet_noise_;
  NoiseSource ack_noise_;
  std::deque<PacketBytes> radio_queue_;  // the first one stays until its ACK is known to have arrived
  std::deque<PacketBytes> vehicle_queue_;
  bool safelink_ = false;
  std::uint8_t up_ = 1;
  std::uint8_t down_ = 1;
  Sent last_kind_ = Sent::kIdle;
  PacketBytes last_sent_;
  Duration unlived_{};    // less than the vehicle's tick
  unsigned flushes_ = 0;  // of the vehicle that were followed
  std::vector<SentPacket> queued_log_;
  std::vector<PacketBytes> uplink_;
  std::uint64_t dropped_ = 0;
};

}  // namespace swiftlet
