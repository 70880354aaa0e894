// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes on a connection to the page's server, which must answer or close.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "core/base/check.hpp"
#include "daemon/view/view_service.hpp"
#include "tests/fuzz/shown_run.hpp"

namespace swiftlet {
namespace {

sockaddr_in loopback_address(std::uint32_t host, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + host);
  address.sin_port = htons(port);
  return address;
}

/// The server and what it shows.
class Server {
 public:
  Server() {
    auto opened = ViewService::open({.host = "127.0.0.1", .port = 0},
                                    {.title = "fuzz", .is_recording = true, .rate = 1.0}, {"file://"});
    SWIFTLET_CHECK(opened, "the server listens");
    service_ = std::move(opened).value();
    const std::lock_guard lock(service_->shared().mutex);
    service_->shared().history = run_.shared.history;
    const std::string url = service_->server().url();
    port_ = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }
  /// Sends the bytes and reads until the server closes.
  void converse(std::span<const std::uint8_t> bytes) {
    const int connection = connected();
    static_cast<void>(::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL));
    ::shutdown(connection, SHUT_WR);
    std::array<char, 65536> answer;
    ssize_t received = 1;
    while (received > 0) received = ::recv(connection, answer.data(), answer.size(), 0);
    SWIFTLET_CHECK(received == 0 || errno != EAGAIN, "the server closes what has ended");
    ::close(connection);
  }

 private:
  /// The fuzzer's alarm may interrupt a call, and the system may be short of something for a moment: tried
  /// thrice. From many addresses: closed connections keep their ports for a minute.
  int connected() {
    constexpr std::uint32_t kHosts = 1U << 16U;
    const timeval patience{.tv_sec = 5, .tv_usec = 0};
    const sockaddr_in to = loopback_address(1, port_);
    for (int attempt = 0; attempt < 3; ++attempt) {
      const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      const sockaddr_in from = loopback_address(2 + connections_++ % kHosts, 0);
      if (::bind(connection, reinterpret_cast<const sockaddr*>(&from), sizeof from) == 0 &&
          ::connect(connection, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0)
        return connection;
      std::perror("web_connection_fuzz: not connected");
      ::close(connection);
    }
    SWIFTLET_CHECK(false, "the server accepts");
    return -1;
  }

  ShownRun run_;
  std::unique_ptr<ViewService> service_;
  std::uint16_t port_ = 0;
  std::uint32_t connections_ = 0;
};

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static swiftlet::Server server;
  server.converse({data, size});
  return 0;
}
