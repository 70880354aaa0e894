// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace swiftlet {

// What is known of the network before LCM is asked, which reports every failure in several lines on stderr.

/// Whether datagrams to this IPv4 address leave by any way. True for what is no address.
[[nodiscard]] bool has_route_to(const std::string& address);

/// "tcpq://127.0.0.1:7700"
[[nodiscard]] std::string lcm_server_url(const sockaddr_in& address);

/// The server of a tcpq:// URL. One thread at a time.
class LcmServer {
 public:
  /// nullopt for other URLs.
  [[nodiscard]] static std::optional<LcmServer> of_url(const std::string& url);

  /// Whether it answered as LCM's server at the last look. Looks again every 5 s while it did not, which
  /// takes 0.7 s at most, beside the time in which a name is resolved.
  [[nodiscard]] bool is_there();
  /// It has gone: the next look is due.
  void mark_lost() { is_there_ = false; }
  /// What LCM reaches the server by, which takes a name for this machine. Empty before its name was resolved.
  [[nodiscard]] const std::string& numeric_url() const { return numeric_url_; }

 private:
  LcmServer(std::string host, std::string port) : host_(std::move(host)), port_(std::move(port)) {}
  [[nodiscard]] bool accepts();

  std::string host_;
  std::string port_;
  std::string numeric_url_;
  bool is_there_ = false;
  std::chrono::steady_clock::time_point next_look_{};
};

}  // namespace swiftlet
