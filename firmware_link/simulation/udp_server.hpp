// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {

/// Disturbances of the packets on their way.
struct PacketFaults {
  double loss_share = 0.0;       ///< that never arrive, in each direction
  double duplicate_share = 0.0;  ///< that arrive twice, from the vehicle
  Duration delay{0};             ///< of what comes from the vehicle
};

/// A simulated vehicle on a UDP socket: one datagram is one CRTP packet, a null packet of one byte is
/// answered with `f3`. Requests are answered to their sender; log data and console text go to the peer: the
/// sender of the last request. A null packet from elsewhere is a scan, which the vehicle does not receive:
/// its console text at boot waits for a client. The vehicle runs at the clock's pace. One thread at a time;
/// allocates.
class SimulatedUdpServer {
 public:
  /// `host`: IPv4 address; port 0: any free one. The vehicle and the clock must outlive the server. Noise
  /// source: "udp". Errors: kInvalidInput: no such address, or the port is in use.
  static Result<std::unique_ptr<SimulatedUdpServer>> open(const std::string& host, std::uint16_t port,
                                                          SimulatedVehicle& vehicle, LinkClock& clock,
                                                          std::uint64_t seed);
  ~SimulatedUdpServer();
  SimulatedUdpServer(const SimulatedUdpServer&) = delete;
  SimulatedUdpServer& operator=(const SimulatedUdpServer&) = delete;

  /// For poll(): readable when datagrams wait.
  [[nodiscard]] int socket_fd() const { return socket_; }
  /// `address:port` as bound.
  [[nodiscard]] std::string address() const;
  /// The client of the vehicle: `address:port`, from its first packet that is no null packet until the link
  /// has timed out.
  [[nodiscard]] std::optional<std::string> client() const;

  /// Receives what has arrived, advances the vehicle until now and sends what is due. Never waits; to be
  /// called every few milliseconds.
  void serve();

  void set_faults(const PacketFaults& faults) { faults_ = faults; }
  [[nodiscard]] const PacketFaults& faults() const { return faults_; }
  /// Receives and sends nothing for that long.
  void silence(Duration duration) { silent_until_ = clock_.now() + duration; }

 private:
  struct Flying {
    HostTime due;
    sockaddr_in to;
    PacketBytes bytes;
  };

  SimulatedUdpServer(int socket, SimulatedVehicle& vehicle, LinkClock& clock, std::uint64_t seed);
  void live_on();
  void on_frame();
  void on_frame(std::span<const std::uint8_t> packet, const sockaddr_in& from);
  void send(const PacketBytes& bytes, const sockaddr_in& to);
  void send_due();
  [[nodiscard]] bool is_silent() const { return clock_.now() < silent_until_; }

  int socket_;
  SimulatedVehicle& vehicle_;
  LinkClock& clock_;
  NoiseSource noise_;
  PacketFaults faults_;
  HostTime began_at_;
  DeviceTime vehicle_began_at_;
  HostTime silent_until_{};
  std::optional<sockaddr_in> peer_;
  DeviceTime peer_received_at_{};  ///< by the vehicle's time, as its own time-out
  std::deque<Flying> flying_;
};

}  // namespace swiftlet
