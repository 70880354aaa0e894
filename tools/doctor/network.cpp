// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/network.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>

namespace swiftlet {
namespace {

class UdpSocket {
 public:
  UdpSocket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~UdpSocket() {
    if (fd_ >= 0) close(fd_);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_;
};

sockaddr_in ipv4(const std::string& address, in_port_t port_network_order) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = port_network_order;
  inet_pton(AF_INET, address.c_str(), &place.sin_addr);
  return place;
}
const sockaddr* generic(const sockaddr_in& place) { return reinterpret_cast<const sockaddr*>(&place); }
sockaddr* generic(sockaddr_in& place) { return reinterpret_cast<sockaddr*>(&place); }

template <typename Option>
bool set_option(int fd, int level, int name, const Option& option) {
  return setsockopt(fd, level, name, &option, sizeof option) == 0;
}

std::optional<sockaddr_in> name_of(int fd) {
  sockaddr_in place{};
  socklen_t size = sizeof place;
  if (getsockname(fd, generic(place), &size) != 0) return std::nullopt;
  return place;
}

Error failed(const std::string& what) { return {ErrorCode::kNotFound, what + ": " + std::strerror(errno)}; }

/// The interface that bears a local address.
std::optional<NetworkRoute> interface_with(const in_addr& address) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(all, freeifaddrs);
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const auto* own = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (own->sin_addr.s_addr == address.s_addr)
      return NetworkRoute{.interface = one->ifa_name,
                          .is_loopback = (one->ifa_flags & IFF_LOOPBACK) != 0,
                          .is_multicast = (one->ifa_flags & IFF_MULTICAST) != 0};
  }
  return std::nullopt;
}

}  // namespace

std::optional<NetworkRoute> SystemNetwork::route_to(const std::string& address) {
  constexpr in_port_t kAnyPort = 9;  // nothing is sent
  const UdpSocket probe;
  const sockaddr_in far = ipv4(address, htons(kAnyPort));
  if (connect(probe.fd(), generic(far), sizeof far) != 0) return std::nullopt;
  std::optional<sockaddr_in> near = name_of(probe.fd());
  if (!near) return std::nullopt;
  // A route over an interface without an address that others know leaves the source open: that of loopback.
  if (near->sin_addr.s_addr == htonl(INADDR_ANY)) near->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return interface_with(near->sin_addr);
}

Status SystemNetwork::send_to_self(const std::string& group) {
  constexpr std::string_view kText = "swiftlet doctor";
  constexpr unsigned char kStaysHere = 0;
  constexpr timeval kHalfSecond{.tv_sec = 0, .tv_usec = 500'000};
  const UdpSocket receiver;
  const sockaddr_in any_port = ipv4("0.0.0.0", 0);
  if (bind(receiver.fd(), generic(any_port), sizeof any_port) != 0) return failed("no free port");
  const std::optional<sockaddr_in> bound = name_of(receiver.fd());
  if (!bound) return failed("no free port");
  const sockaddr_in target = ipv4(group, bound->sin_port);
  const ip_mreq membership{.imr_multiaddr = target.sin_addr, .imr_interface = {INADDR_ANY}};
  if (!set_option(receiver.fd(), IPPROTO_IP, IP_ADD_MEMBERSHIP, membership) ||
      !set_option(receiver.fd(), SOL_SOCKET, SO_RCVTIMEO, kHalfSecond))
    return failed("cannot join group " + group);

  const UdpSocket sender;
  if (!set_option(sender.fd(), IPPROTO_IP, IP_MULTICAST_TTL, kStaysHere) ||
      sendto(sender.fd(), kText.data(), kText.size(), 0, generic(target), sizeof target) < 0)
    return failed("cannot send to " + group);
  char received[32];
  const ssize_t size = recv(receiver.fd(), received, sizeof received, 0);
  if (size < 0) return Error{ErrorCode::kTimeout, "a datagram sent to " + group + " did not come back"};
  return std::string_view(received, static_cast<std::size_t>(size)) == kText
             ? Status()
             : Error{ErrorCode::kDamaged, "something else than what was sent came back"};
}

}  // namespace swiftlet
