// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/web_answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const PageFiles kFiles{{"/", {"text/html", "page"}}, {"/view.js", {"text/javascript", "script"}}};
const OwnNames kOwn{.is_loopback = true, .names = {}, .foreign_origins = {}};

WebRequest request(std::string_view target) {
  return {.head = {.method = "GET", .host = "localhost:8440", .origin = {}},
          .target = target,
          .subprotocols = {},
          .keeps_alive = true};
}

TEST(WebAnswer, AFileIsFoundByItsPathWithoutTheQuery) {
  for (const char* target : {"/view.js", "/view.js?", "/view.js?7/../x"}) {
    const WebAnswer answer = answer_request(request(target), kFiles, kOwn);
    EXPECT_EQ(answer.status, 200) << target;
    EXPECT_EQ(answer.file.bytes, "script") << target;
    EXPECT_TRUE(answer.keeps_alive) << target;
  }
}

TEST(WebAnswer, WhatIsNoPageIsNotFound) {
  for (const char* target : {"", "?", "/VIEW.JS", "//", "/../view.js", "http://localhost/view.js"}) {
    const WebAnswer answer = answer_request(request(target), kFiles, kOwn);
    EXPECT_EQ(answer.status, 404) << target;
    EXPECT_FALSE(answer.socket) << target;
  }
}

TEST(WebAnswer, WhoIsRefusedGetsNeitherFileNorSocket) {
  WebRequest foreign = request("/");
  foreign.head.host = "evil.example";
  for (const bool wants_socket : {false, true}) {
    foreign.wants_socket = wants_socket;
    const WebAnswer answer = answer_request(foreign, kFiles, kOwn);
    EXPECT_EQ(answer.status, 403);
    EXPECT_FALSE(answer.socket);
    EXPECT_FALSE(answer.keeps_alive);
  }
}

TEST(WebAnswer, ASocketIsAskedForByPathAndSubprotocols) {
  WebRequest wanted = request("/live?1");
  wanted.wants_socket = true;
  const WebAnswer plain = answer_request(wanted, kFiles, kOwn);
  ASSERT_TRUE(plain.socket);
  EXPECT_EQ(plain.socket->path, "/live");
  EXPECT_THAT(plain.socket->subprotocols, IsEmpty());
  wanted.subprotocols = {"foxglove.sdk.v1", "other"};
  EXPECT_THAT(answer_request(wanted, kFiles, kOwn).socket->subprotocols,
              ElementsAre("foxglove.sdk.v1", "other"));
}

}  // namespace
}  // namespace swiftlet
