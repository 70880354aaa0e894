// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "daemon/system/default_addresses.hpp"
#include "daemon/view/web_site.hpp"

namespace swiftlet {

struct ListenAddress {
  std::string host = "127.0.0.1";  ///< IPv4 or IPv6 address, or localhost
  std::uint16_t port = kViewPort;  ///< 0: any that is free
};
/// `HOST:PORT`, `HOST` or an IPv6 address in brackets. Error: kInvalidInput: it is none of these.
[[nodiscard]] Result<ListenAddress> parse_listen_address(std::string_view text);

/// HTTP and WebSockets for browsers: serves files, and offers each Conversation the chance to send 25 times a
/// second and whenever its last message has left. At most 64 connections; requests that a foreign page or
/// name made are refused (request_check.hpp).
class WebServer {
 public:
  /// Listens. Error: kInvalidInput: it cannot listen there.
  [[nodiscard]] static Result<std::unique_ptr<WebServer>> open(const ListenAddress& address, WebSite site);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Where a browser finds it: http://HOST:PORT
  [[nodiscard]] std::string url() const;
  /// Whether other machines reach it.
  [[nodiscard]] bool is_beyond_this_machine() const;
  /// Serves in the calling thread until `stop` is requested. Call once.
  void run(const std::stop_token& stop);

 private:
  struct State;
  explicit WebServer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
