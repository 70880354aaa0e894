// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/network.hpp"

#include <gmock/gmock.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

namespace swiftlet {
namespace {

constexpr const char* kGroup = "239.255.76.67";

TEST(SystemNetwork, KnowsTheRouteOfThisMachineToItself) {
  SystemNetwork network;
  const std::optional<NetworkRoute> route = network.route_to("127.0.0.1");
  ASSERT_TRUE(route.has_value());
  EXPECT_TRUE(route->is_loopback);
}

TEST(SystemNetwork, HearsItsOwnMulticastWhereThereIsARoute) {
  SystemNetwork network;
  if (!network.route_to(kGroup)) GTEST_SKIP() << "no route to multicast groups on this machine";
  const Status received = network.send_to_self(kGroup);
  EXPECT_TRUE(received.ok()) << received.error().message;
}

// Exit codes of the child that lives in an empty network.
constexpr int kAsExpected = 0;
constexpr int kUnexpected = 1;
constexpr int kMayNotUnshare = 2;

bool finds_no_route() {
  SystemNetwork network;
  const Status received = network.send_to_self(kGroup);
  return !network.route_to(kGroup) && !received;
}

void set(sockaddr& place, in_addr_t address) {
  sockaddr_in ipv4{};
  ipv4.sin_family = AF_INET;
  ipv4.sin_addr.s_addr = htonl(address);
  std::memcpy(&place, &ipv4, sizeof ipv4);
}

/// What the doctor's remedy does: ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo
bool route_multicast_over_loopback() {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  char name[] = "lo";
  ifreq up{};
  std::memcpy(up.ifr_name, name, sizeof name);
  up.ifr_flags = IFF_UP | IFF_MULTICAST;
  rtentry route{};
  set(route.rt_dst, 0xE0000000);
  set(route.rt_genmask, 0xF0000000);
  route.rt_flags = RTF_UP;
  route.rt_dev = name;
  const bool done = ioctl(fd, SIOCSIFFLAGS, &up) == 0 && ioctl(fd, SIOCADDRT, &route) == 0;
  close(fd);
  return done;
}

bool finds_the_route_over_loopback() {
  if (!route_multicast_over_loopback()) return false;
  SystemNetwork network;
  const std::optional<NetworkRoute> route = network.route_to(kGroup);
  return route && route->is_loopback && route->is_multicast && network.send_to_self(kGroup).ok();
}

/// In a child process with a network of its own, in which nothing is up yet: its exit code.
int in_an_empty_network(bool (*look)()) {
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) _exit(kMayNotUnshare);
    _exit(look() ? kAsExpected : kUnexpected);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : kUnexpected;
}

TEST(SystemNetwork, NoticesThatThereIsNoRoute) {
  const int code = in_an_empty_network(finds_no_route);
  if (code == kMayNotUnshare) GTEST_SKIP() << "this user may not make network namespaces";
  EXPECT_EQ(code, kAsExpected);
}

TEST(SystemNetwork, FindsARouteOverLoopbackThatHasNoSourceAddress) {
  const int code = in_an_empty_network(finds_the_route_over_loopback);
  if (code == kMayNotUnshare) GTEST_SKIP() << "this user may not make network namespaces";
  EXPECT_EQ(code, kAsExpected);
}

}  // namespace
}  // namespace swiftlet
