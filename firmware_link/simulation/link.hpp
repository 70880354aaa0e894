// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string_view>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/simulation/spared_errors.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {

/// A simulated vehicle in a simulated world behind a link that delivers every request and reply, loses some
/// log packets and polls the vehicle as a radio does. Time is simulated too: receive() advances it to the
/// next frame and never waits; host time is a fixed date plus simulated time, so a run is repeatable byte for
/// byte. One thread at a time; allocates.
class SimulatedLink final : public Link {
 public:
  /// `world`: one of simulated_world_names(), its script flown `laps` times on a battery that lasts as long.
  /// Error: kNotFound, the message lists the worlds. Precondition: laps >= 1.
  static Result<std::unique_ptr<SimulatedLink>> open(std::string_view world, std::uint64_t seed, int laps = 1,
                                                     const SparedErrors& spared = {});

  /// Of log packets, the share that never arrives. Noise source: "packet_loss".
  static constexpr double kPacketLoss = 0.01;
  SimulatedLink(SimulatedWorld world, const VehicleModel& model, double packet_loss, std::uint64_t seed);

  /// Errors: kTimeout: nothing came within `timeout` of simulated time, which has passed now.
  /// kEndOfRecording: the vehicle has landed and everything it sent was delivered.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Error: kInvalidInput: a packet has 1 to 31 bytes.
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;

  /// The truth at any time of the vehicle's clock in the last minute.
  [[nodiscard]] Pose2 T_world_body(DeviceTime at) { return vehicle_.T_world_body(at); }
  [[nodiscard]] const SimulatedWorld& world() const { return vehicle_.world(); }
  /// Of the flight, 0 to 1.
  [[nodiscard]] double progress() const { return vehicle_.progress(); }

 private:
  void poll();
  void queue(LinkDirection direction, DeviceTime at, std::span<const std::uint8_t> packet);
  [[nodiscard]] HostTime host_time(DeviceTime at) const;

  SimulatedVehicle vehicle_;
  NoiseSource loss_noise_;
  double packet_loss_;
  DeviceTime opened_at_;
  DeviceTime polled_at_;
  std::deque<LinkFrame> received_;
};

}  // namespace swiftlet
