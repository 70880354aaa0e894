// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

/// A UDP socket that stands for a vehicle to one client at a time: a datagram is a packet of 1 to 31 bytes.
/// Who sends a packet or `f3` while there is no client becomes it, until it sends `f4` or nothing for
/// kSilence, or another one comes after it has closed its socket. A null packet is answered with `f3`, a scan
/// by others too, as long as there is no client. Reads and sends without waiting; allocates nothing after
/// open(); one thread at a time.
class ClientSocket {
 public:
  /// The vendor's client sends a ping a second.
  static constexpr Duration kSilence = std::chrono::seconds(3);

  /// Errors: kInvalidInput: no IPv4 address of this machine, or the port is in use.
  static Result<std::unique_ptr<ClientSocket>> open(const UdpAddress& address);
  ~ClientSocket() { close(); }
  ClientSocket(const ClientSocket&) = delete;
  ClientSocket& operator=(const ClientSocket&) = delete;

  /// Notifies the client by a line of console text; the system refuses its next packet. There is no client
  /// from now on.
  void close();

  [[nodiscard]] int file() const { return socket_; }
  /// As bound: port 0 means any that is free.
  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] bool has_client() const { return client_.has_value(); }

  struct Arrival {
    bool is_any = false;                   ///< false: nothing waits
    bool ended = false;                    ///< the client is gone
    std::span<const std::uint8_t> packet;  ///< of the client (the next one), if not empty; valid until the
                                           ///< next call
  };
  /// Reads one datagram. `is_connected`: the vehicle is received: null packets are answered.
  [[nodiscard]] Arrival receive(HostTime now, bool is_connected);
  /// Whether the client has sent nothing for too long; then there is none.
  [[nodiscard]] bool has_fallen_silent(HostTime now);
  /// To the client, if there is one. What the system does not take is lost.
  void send(std::span<const std::uint8_t> packet) const;
  /// Notifies the client by a line of console text that it has no log blocks any more.
  void report_lost_blocks();

  /// kClientConnected, kClientGone, kClientRefused, kClientBlocksLost.
  [[nodiscard]] std::optional<VehicleEvent> take_event();

 private:
  explicit ClientSocket(int socket) : socket_(socket) {}
  [[nodiscard]] Arrival on_clients(std::span<const std::uint8_t> packet, bool is_connected);
  [[nodiscard]] Arrival on_strangers(std::span<const std::uint8_t> packet, const sockaddr_in& from,
                                     HostTime now, bool is_connected);
  [[nodiscard]] bool client_has_closed() const;
  void drop_errors() const;
  void refuse(const sockaddr_in& from);
  void lose_client();
  void print(std::string_view line);
  void send(std::span<const std::uint8_t> packet, const sockaddr_in& to) const;
  void report(VehicleEvent::Kind kind, std::int32_t value = 0);

  int socket_;  ///< -1: closed
  std::optional<sockaddr_in> client_;
  FixedVector<sockaddr_in, 8> refused_;  ///< and told of, while this client is there
  HostTime received_at_{};               ///< from the client
  std::array<std::uint8_t, 64> buffer_{};
  FixedVector<VehicleEvent, 8> events_;
};

}  // namespace swiftlet
