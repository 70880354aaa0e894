// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/network.hpp"

#include <gmock/gmock.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

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
  const Status heard = network.send_to_self(kGroup);
  EXPECT_TRUE(heard.ok()) << heard.error().message;
}

// Exit codes of the child that lives in an empty network.
constexpr int kAsExpected = 0;
constexpr int kUnexpected = 1;
constexpr int kMayNotUnshare = 2;

[[noreturn]] void look_around_in_an_empty_network() {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) _exit(kMayNotUnshare);
  SystemNetwork network;
  const Status heard = network.send_to_self(kGroup);
  _exit(!network.route_to(kGroup) && !heard ? kAsExpected : kUnexpected);
}

TEST(SystemNetwork, NoticesThatThereIsNoRoute) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) look_around_in_an_empty_network();
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kMayNotUnshare) GTEST_SKIP() << "this user may not make network namespaces";
  EXPECT_EQ(WEXITSTATUS(status), kAsExpected);
}

}  // namespace
}  // namespace swiftlet
