// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/check.hpp"

namespace swiftlet::test {

/// A service manager for this process: the socket that NOTIFY_SOCKET names, and a watchdog's period.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path, std::chrono::microseconds watchdog) : path_(path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    SWIFTLET_CHECK(path_.size() < sizeof address.sun_path, "a socket's path is short");
    path_.copy(address.sun_path, path_.size());
    std::filesystem::remove(path_);
    const bool bound = ::bind(socket_, std::bit_cast<const sockaddr*>(&address), sizeof address) == 0;
    SWIFTLET_CHECK(bound, "tests may make sockets");
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
    ::setenv("WATCHDOG_USEC", std::to_string(watchdog.count()).c_str(), 1);
    ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  }
  ~NotifySocket() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    ::close(socket_);
    std::filesystem::remove(path_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// What has come since the last call, in order.
  std::vector<std::string> received() {
    std::vector<std::string> all;
    std::array<char, 1024> text{};
    for (ssize_t size = receive(text); size >= 0; size = receive(text))
      all.emplace_back(text.data(), static_cast<std::size_t>(size));
    return all;
  }

 private:
  ssize_t receive(std::array<char, 1024>& text) const {
    return ::recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
  }

  std::string path_;
  int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

}  // namespace swiftlet::test
