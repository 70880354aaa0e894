// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "core/base/time.hpp"

namespace swiftlet {

// What is known of the network before LCM is asked, which reports every failure in several lines on stderr.

/// Whether datagrams to this IPv4 address leave by any way. True for what is no address.
[[nodiscard]] bool has_route_to(const std::string& address);

/// "tcpq://127.0.0.1:7700"
[[nodiscard]] std::string lcm_server_url(const sockaddr_in& address);

/// The server of a tcpq:// URL, looked for in a thread of its own: a name that does not resolve takes its
/// time. The destructor waits for a look that goes on. One thread at a time.
class LcmServer {
 public:
  /// nullopt for other URLs. A look waits for the server's answer for `patience` at most.
  [[nodiscard]] static std::optional<LcmServer> of_url(const std::string& url, Duration patience);

  /// Whether it answered as LCM's server at the last look. While it did not, a look begins every 5 s.
  [[nodiscard]] bool is_there();
  /// Until a look that is_there() began is over: its patience and 0.2 s at most, beside the time in which a
  /// name is resolved.
  void wait_for_look() const;
  /// It has gone: the next look is due.
  void mark_lost() { is_there_ = false; }
  /// What LCM reaches the server by, which takes a name for this machine. Empty before its name was resolved.
  [[nodiscard]] const std::string& numeric_url() const { return numeric_url_; }

 private:
  LcmServer(std::string host, std::string port, Duration patience)
      : host_(std::move(host)), port_(std::move(port)), patience_(patience) {}

  std::string host_;
  std::string port_;
  Duration patience_;
  std::string numeric_url_;
  bool is_there_ = false;
  std::chrono::steady_clock::time_point next_look_{};
  std::future<std::optional<std::string>> look_;  ///< of an answer: where from
};

}  // namespace swiftlet
