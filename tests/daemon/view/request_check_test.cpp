// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/request_check.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

const OwnNames kLoopback{.is_loopback = true, .names = {"mybox"}, .foreign_origins = {}};
const OwnNames kNetwork{.is_loopback = false, .names = {"mybox", "mybox.local"}, .foreign_origins = {}};

bool passes(std::string_view host, const OwnNames& own, std::optional<std::string_view> origin = {}) {
  return !refuse_request({.method = "GET", .host = host, .origin = origin}, own);
}

TEST(RequestCheck, LoopbackNamesPassAtAnyPort) {
  EXPECT_TRUE(passes("127.0.0.1:8440", kLoopback));
  EXPECT_TRUE(passes("localhost:9000", kLoopback));
  EXPECT_TRUE(passes("LOCALHOST", kLoopback));
  EXPECT_TRUE(passes("[::1]:8440", kLoopback));
}

TEST(RequestCheck, ANameThatOnlyResolvesHereIsRefused) {
  for (const char* host : {"evil.example:8440", "127.0.0.1.evil.example", "localhost.evil.example", "", "[",
                           "[]", "192.168.0.5:8440", "mybox:8440"})
    EXPECT_FALSE(passes(host, kLoopback)) << host;
}

TEST(RequestCheck, OnANetworkAddressesAndTheMachinesOwnNamesPass) {
  EXPECT_TRUE(passes("192.168.0.5:8440", kNetwork));
  EXPECT_TRUE(passes("[fe80::1]:8440", kNetwork));
  EXPECT_TRUE(passes("MyBox.local:8440", kNetwork));
  EXPECT_FALSE(passes("evil.example:8440", kNetwork));
}

TEST(RequestCheck, APageOfAnotherSiteIsRefused) {
  EXPECT_TRUE(passes("127.0.0.1:8440", kLoopback, "http://127.0.0.1:8440"));
  for (const char* origin :
       {"http://evil.example", "http://127.0.0.1:8441", "https://127.0.0.1:8440", "null", ""})
    EXPECT_FALSE(passes("127.0.0.1:8440", kLoopback, origin)) << origin;
}

TEST(RequestCheck, AnOriginThatIsAllowedPassesAsAWhole) {
  const OwnNames own{
      .is_loopback = true, .names = {}, .foreign_origins = {"https://app.foxglove.dev", "file://"}};
  for (const char* origin : {"https://app.foxglove.dev", "HTTPS://App.Foxglove.dev", "file://"})
    EXPECT_TRUE(passes("127.0.0.1:8440", own, origin)) << origin;
  for (const char* origin :
       {"http://app.foxglove.dev", "https://app.foxglove.dev:8443", "https://foxglove.dev",
        "https://app.foxglove.dev.evil.example", "file:///x", "*", "null", ""})
    EXPECT_FALSE(passes("127.0.0.1:8440", own, origin)) << origin;
  EXPECT_FALSE(passes("evil.example", own, "https://app.foxglove.dev"))
      << "the name of the server still counts";
}

TEST(RequestCheck, NothingButReadingIsAnswered) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", ""})
    EXPECT_EQ(refuse_request({.method = method, .host = "localhost", .origin = {}}, kLoopback)->status, 405);
  EXPECT_FALSE(refuse_request({.method = "HEAD", .host = "localhost", .origin = {}}, kLoopback));
}

}  // namespace
}  // namespace swiftlet
