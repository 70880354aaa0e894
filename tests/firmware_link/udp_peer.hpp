// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/check.hpp"

namespace swiftlet {

/// The other end of a UDP link, on its own loopback port; sends to the sender of the last datagram.
class UdpPeer {
 public:
  /// Port 0: any that is free.
  explicit UdpPeer(std::uint16_t port = 0) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    socklen_t size = sizeof(address);
    const bool bound = ::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                       ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    SWIFTLET_CHECK(bound, "a loopback port can be bound");
    port_ = ntohs(address.sin_port);
  }
  ~UdpPeer() { ::close(socket_); }
  UdpPeer(const UdpPeer&) = delete;
  UdpPeer& operator=(const UdpPeer&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }

  /// The next datagram, if one comes within the time.
  std::optional<std::vector<std::uint8_t>> receive(int timeout_ms) {
    pollfd watched{.fd = socket_, .events = POLLIN, .revents = 0};
    if (::poll(&watched, 1, timeout_ms) <= 0) return std::nullopt;
    std::array<std::uint8_t, 2048> bytes{};
    socklen_t size = sizeof(client_);
    const ssize_t length =
        ::recvfrom(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&client_), &size);
    if (length < 0) return std::nullopt;
    return std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + length);
  }
  /// Precondition: a datagram was received.
  void send(std::span<const std::uint8_t> bytes) const {
    const ssize_t sent = ::sendto(socket_, bytes.data(), bytes.size(), 0,
                                  reinterpret_cast<const sockaddr*>(&client_), sizeof(client_));
    SWIFTLET_CHECK(sent == static_cast<ssize_t>(bytes.size()), "loopback takes every datagram");
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
  sockaddr_in client_{};
};

}  // namespace swiftlet
