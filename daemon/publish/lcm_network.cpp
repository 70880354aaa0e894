// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_network.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string_view>

namespace swiftlet {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

constexpr std::string_view kServer = "tcpq://";
constexpr const char* kDefaultHost = "127.0.0.1";
constexpr const char* kDefaultPort = "7700";
constexpr std::chrono::seconds kLookEvery{5};
constexpr int kConnectMs = 200;

class Socket {
 public:
  explicit Socket(int type) : file_(::socket(AF_INET, type | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (file_ >= 0) ::close(file_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  [[nodiscard]] int file() const { return file_; }

 private:
  int file_;
};

/// Host and port of a tcpq:// URL, either may be empty.
std::optional<std::pair<std::string, std::string>> place_in(const std::string& url) {
  if (!url.starts_with(kServer)) return std::nullopt;
  std::string place = url.substr(kServer.size());
  place = place.substr(0, place.find('?'));
  const std::size_t colon = place.find(':');
  if (colon == std::string::npos) return std::pair(place, std::string());
  return std::pair(place.substr(0, colon), place.substr(colon + 1));
}

bool is_connected(int socket, const addrinfo& to) {
  if (::connect(socket, to.ai_addr, to.ai_addrlen) == 0) return true;
  if (errno != EINPROGRESS) return false;
  pollfd answer{.fd = socket, .events = POLLOUT, .revents = 0};
  int failure = ETIMEDOUT;
  socklen_t size = sizeof failure;
  return ::poll(&answer, 1, kConnectMs) == 1 &&
         ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &failure, &size) == 0 && failure == 0;
}

/// As LCM greets, which would wait for the answer for ever: with a word of its own, then the version.
bool is_greeted(int socket, Duration patience) {
  constexpr std::array<std::uint8_t, 8> kGreeting{0x28, 0x76, 0x17, 0xFB, 0, 0, 1, 0};
  constexpr std::array<std::uint8_t, 4> kExpected{0x28, 0x76, 0x17, 0xFA};
  constexpr int kWholeAnswer = kGreeting.size();
  if (::setsockopt(socket, SOL_SOCKET, SO_RCVLOWAT, &kWholeAnswer, sizeof kWholeAnswer) != 0 ||
      ::send(socket, kGreeting.data(), kGreeting.size(), MSG_NOSIGNAL) != std::ssize(kGreeting))
    return false;
  pollfd answer{.fd = socket, .events = POLLIN, .revents = 0};
  std::array<std::uint8_t, kWholeAnswer> bytes{};
  const auto patience_ms = std::chrono::ceil<std::chrono::milliseconds>(patience).count();
  return ::poll(&answer, 1, static_cast<int>(patience_ms)) == 1 &&
         ::recv(socket, bytes.data(), bytes.size(), 0) == std::ssize(bytes) &&
         std::equal(kExpected.begin(), kExpected.end(), bytes.begin());
}

/// The numeric URL of a server that answers there.
std::optional<std::string> find_server(const std::string& host, const std::string& port, Duration patience) {
  const addrinfo wanted{.ai_flags = 0,
                        .ai_family = AF_INET,
                        .ai_socktype = SOCK_STREAM,
                        .ai_protocol = 0,
                        .ai_addrlen = 0,
                        .ai_addr = nullptr,
                        .ai_canonname = nullptr,
                        .ai_next = nullptr};
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found) != 0) return std::nullopt;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> address(found, ::freeaddrinfo);
  const Socket socket(SOCK_STREAM | SOCK_NONBLOCK);
  if (!is_connected(socket.file(), *address) || !is_greeted(socket.file(), patience)) return std::nullopt;
  return lcm_server_url(*reinterpret_cast<const sockaddr_in*>(address->ai_addr));
}

}  // namespace

bool has_route_to(const std::string& address) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(1);  // nothing is sent
  if (inet_pton(AF_INET, address.c_str(), &to.sin_addr) != 1) return true;
  const Socket socket(SOCK_DGRAM);
  return ::connect(socket.file(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 ||
         (errno != ENETUNREACH && errno != EHOSTUNREACH);
}

std::string lcm_server_url(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> host{};
  ::inet_ntop(AF_INET, &address.sin_addr, host.data(), host.size());
  return std::string(kServer) + host.data() + ":" + std::to_string(ntohs(address.sin_port));
}

std::optional<LcmServer> LcmServer::of_url(const std::string& url, Duration patience) {
  const auto place = place_in(url);
  if (!place) return std::nullopt;
  return LcmServer(place->first.empty() ? kDefaultHost : place->first,
                   place->second.empty() ? kDefaultPort : place->second, patience);
}

bool LcmServer::is_there() {
  const auto now = steady_clock::now();
  if (!is_there_ && !look_.valid() && now >= next_look_) {
    next_look_ = now + kLookEvery;
    look_ = std::async(std::launch::async, &find_server, host_, port_, patience_);
  }
  if (look_.valid() && look_.wait_for(0s) == std::future_status::ready) {
    const std::optional<std::string> found = look_.get();
    is_there_ = found.has_value();
    numeric_url_ = found.value_or("");
  }
  return is_there_;
}

void LcmServer::wait_for_look() const {
  if (look_.valid()) look_.wait();
}

}  // namespace swiftlet
