// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// Foxglove's protocol on the wire: handshake and first messages, byte by byte.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "daemon/view/view_service.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A TCP connection within this machine.
class Connection {
 public:
  explicit Connection(const std::string& url) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))));
    const timeval patience{.tv_sec = 20, .tv_usec = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(const std::string& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  std::string receive(std::size_t size) const {
    std::string bytes(size, '\0');
    const ssize_t received = ::recv(socket_, bytes.data(), size, MSG_WAITALL);
    bytes.resize(received < 0 ? 0 : static_cast<std::size_t>(received));
    return bytes;
  }
  std::string receive_head() const {
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string byte = receive(1);
      if (byte.empty()) break;
      head += byte;
    }
    return head;
  }
  /// One message, of any number of frames.
  std::string receive_message(char opcode) const {
    std::string message;
    for (bool is_first = true;; is_first = false) {
      const std::string head = receive(2);
      if (head.size() < 2) return message + "(the connection has ended)";
      EXPECT_EQ(head[0] & 0x7f, is_first ? opcode : 0);
      std::size_t size = static_cast<std::uint8_t>(head[1]);
      EXPECT_LT(size, 128U) << "a server does not mask";
      if (size >= 126) {
        const std::string length = receive(size == 126 ? 2 : 8);
        size = 0;
        for (const char byte : length) size = size << 8U | static_cast<std::uint8_t>(byte);
      }
      message += receive(size);
      if ((head[0] & 0x80) != 0) return message;
    }
  }

 private:
  int socket_;
};

/// A client's text frame with the mask 0, for less than 126 bytes.
std::string text_frame(const std::string& text) {
  return std::string("\x81", 1) + static_cast<char>(0x80U | text.size()) + std::string(4, '\0') + text;
}

std::string handshake(const std::string& more) {
  return "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         more + "\r\n";
}
const std::string kFoxglove = "Sec-WebSocket-Protocol: foxglove.websocket.v1, foxglove.sdk.v1\r\n";

class FoxgloveSocket : public testing::Test {
 protected:
  ShownSource source_{.title = "lcm", .is_recording = false, .rate = 1.0};

  std::unique_ptr<ViewService> service(const std::vector<std::string>& origins = {}) const {
    auto opened = ViewService::open({.host = "127.0.0.1", .port = 0}, source_, origins);
    return opened ? std::move(opened).value() : nullptr;
  }
};

TEST_F(FoxgloveSocket, SpeaksAsTheProtocolHasIt) {
  const auto server = service();
  ASSERT_NE(server, nullptr);
  const Connection client(server->server().url());
  client.send(handshake(kFoxglove));
  EXPECT_THAT(client.receive_head(),
              AllOf(StartsWith("HTTP/1.1 101 Switching Protocols\r\n"),
                    HasSubstr("\r\nSec-WebSocket-Protocol: foxglove.sdk.v1\r\n"),
                    HasSubstr("\r\nSec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n")));
  const std::string info = R"({"op":"serverInfo","name":"swiftlet: lcm","capabilities":[]})";
  EXPECT_EQ(client.receive(2 + info.size()), "\x81" + std::string(1, static_cast<char>(info.size())) + info);
  EXPECT_THAT(
      client.receive_message(1),
      StartsWith(R"({"op":"advertise","channels":[{"id":1,"topic":"/tf","encoding":"json",)"
                 R"("schemaName":"foxglove.FrameTransforms","schemaEncoding":"jsonschema","schema":"{)"));
  client.send(text_frame(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":2}]})"));
  {
    const std::lock_guard lock(server->shared().mutex);
    ASSERT_TRUE(server->shared().history.enter_run(7, 0.0));
    add_whole_pose(server->shared().history, kSecondUs, 0);
  }
  EXPECT_EQ(
      client.receive_message(2),
      std::string("\x01\x09\0\0\0\0\xca\x9a\x3b\0\0\0\0", 13) +
          R"({"timestamp":{"sec":1,"nsec":0},"frame_id":"map","pose":{"position":{"x":1.0,"y":2.0,"z":0.0},)"
          R"("orientation":{"x":0.0,"y":0.0,"z":0.24740395925452294,"w":0.9689124217106447}}})");
}

TEST_F(FoxgloveSocket, AnswersPagesOfOtherSitesWhereTheyAreAllowed) {
  const auto server = service({"https://app.foxglove.dev", "file://"});
  ASSERT_NE(server, nullptr);
  for (const char* origin : {"https://app.foxglove.dev", "file://", "http://localhost"}) {
    const Connection client(server->server().url());
    client.send(handshake(kFoxglove + "Origin: " + origin + "\r\n"));
    EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 101 ")) << origin;
  }
  for (const char* origin :
       {"https://foxglove.dev", "https://app.foxglove.dev.evil.example", "null", "file:///"}) {
    const Connection client(server->server().url());
    client.send(handshake(kFoxglove + "Origin: " + origin + "\r\n"));
    EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 403 ")) << origin;
  }
}

TEST_F(FoxgloveSocket, AnswersNoPageOfAnotherSiteOfItself) {
  const auto server = service();
  ASSERT_NE(server, nullptr);
  for (const char* origin : {"https://app.foxglove.dev", "file://", "null"}) {
    const Connection client(server->server().url());
    client.send(handshake(kFoxglove + "Origin: " + origin + "\r\n"));
    EXPECT_THAT(client.receive_head(), StartsWith("HTTP/1.1 403 ")) << origin;
  }
}

TEST_F(FoxgloveSocket, ThePagesSocketHasNoSubprotocol) {
  const auto server = service();
  ASSERT_NE(server, nullptr);
  const Connection client(server->server().url());
  client.send(handshake("").replace(4, 1, "/live"));
  EXPECT_THAT(client.receive_head(),
              AllOf(StartsWith("HTTP/1.1 101 "), Not(HasSubstr("Sec-WebSocket-Protocol"))));
  const Connection other(server->server().url());
  other.send(handshake("Sec-WebSocket-Protocol: foxglove.websocket.v9\r\n"));
  EXPECT_THAT(other.receive_head(), StartsWith("HTTP/1.1 404 "));
}

}  // namespace
}  // namespace swiftlet
