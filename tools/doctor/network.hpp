// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// Where datagrams to an address leave this machine.
struct NetworkRoute {
  std::string interface;  ///< "lo", "eth0"
  bool is_loopback = false;
  bool is_multicast = false;  ///< the interface has the flag MULTICAST
};

/// What the doctor asks of the network. Addresses are IPv4 in dotted form. One thread at a time.
class Network {
 public:
  Network() = default;
  virtual ~Network() = default;
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// nullopt: there is no route to it.
  [[nodiscard]] virtual std::optional<NetworkRoute> route_to(const std::string& address) = 0;
  /// Joins the group on a free port, sends itself one datagram that must not leave this machine, and waits
  /// for it for half a second. The error names which of these failed.
  [[nodiscard]] virtual Status send_to_self(const std::string& group) = 0;
};

class SystemNetwork final : public Network {
 public:
  [[nodiscard]] std::optional<NetworkRoute> route_to(const std::string& address) override;
  [[nodiscard]] Status send_to_self(const std::string& group) override;
};

}  // namespace swiftlet
