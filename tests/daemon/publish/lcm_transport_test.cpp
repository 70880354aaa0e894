// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/publish/lcm_network.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience{30};

TEST(LcmTransport, BringsWhatWasPublishedToWhoeverListensOnTheChannel) {
  const auto lcm = LcmTransport::open("memq://");
  ASSERT_TRUE(lcm.ok());
  std::vector<std::uint8_t> received;
  (*lcm)->listen("HERE", [&received](auto bytes) { received.assign(bytes.begin(), bytes.end()); });
  const std::vector<std::uint8_t> message{1, 2, 3};
  EXPECT_TRUE((*lcm)->publish("THERE", std::vector<std::uint8_t>{9}));
  EXPECT_TRUE((*lcm)->publish("HERE", message));
  for (int i = 0; i < 100 && received.empty(); ++i) (*lcm)->receive(milliseconds(100));
  EXPECT_THAT(received, ElementsAre(1, 2, 3));
}

TEST(LcmTransport, ComesBackWhenNothingIsToBeHeard) {
  const auto lcm = LcmTransport::open("memq://");
  ASSERT_TRUE(lcm.ok());
  EXPECT_FALSE((*lcm)->receive(milliseconds(10)));
  EXPECT_FALSE((*lcm)->has_ended());
}

TEST(LcmTransport, KnowsTheEndOfALogThatItReads) {
  const std::string log = testing::TempDir() + "swiftlet_lcm_transport_test.lcm";
  ASSERT_TRUE(
      (*LcmTransport::open("file://" + log + "?mode=w"))->publish("HERE", std::vector<std::uint8_t>{7}));
  const auto lcm = LcmTransport::open("file://" + log + "?mode=r&speed=0");
  ASSERT_TRUE(lcm.ok());
  std::vector<std::uint8_t> received;
  (*lcm)->listen("HERE", [&received](auto bytes) { received.assign(bytes.begin(), bytes.end()); });
  for (int i = 0; i < 100 && received.empty(); ++i) (*lcm)->receive(milliseconds(100));
  EXPECT_THAT(received, ElementsAre(7));
  for (int i = 0; i < 100 && !(*lcm)->has_ended(); ++i) EXPECT_FALSE((*lcm)->receive(milliseconds(100)));
  EXPECT_TRUE((*lcm)->has_ended());
  std::filesystem::remove(log);
}

/// While it lives no file of this process grows beyond so many bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit full{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, handler_));
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(LcmTransport, NoticesThatALogIsNotComplete) {
  const std::string log = testing::TempDir() + "swiftlet_lcm_transport_full_test.lcm";
  const std::vector<std::uint8_t> message{1, 2, 3};
  const auto publish_ten = [&message](LcmTransport& lcm) {
    int taken = 0;
    for (int i = 0; i < 10; ++i) taken += lcm.publish("HERE", message) ? 1 : 0;
    return taken;
  };
  const auto lcm = LcmTransport::open("file://" + log + "?mode=w");
  ASSERT_TRUE(lcm.ok());
  EXPECT_EQ(publish_ten(**lcm), 10);
  EXPECT_TRUE((*lcm)->check_log().ok());
  Status lost;
  {
    const FullDisk disk(400);
    EXPECT_EQ(publish_ten(**lcm), 10);
    lost = (*lcm)->check_log();
  }
  ASSERT_FALSE(lost.ok());
  EXPECT_THAT(lost.error().message, HasSubstr(": the LCM log is not complete: 400 of 700 bytes"));
  std::filesystem::remove(log);
}

TEST(LcmTransport, ALogThatIsContinuedKeepsWhatItHad) {
  const std::string log = testing::TempDir() + "swiftlet_lcm_transport_continued_test.lcm";
  std::filesystem::remove(log);
  for (const std::uintmax_t bytes : {33U, 66U}) {
    const auto lcm = LcmTransport::open("file://" + log + "?mode=a");
    ASSERT_TRUE(lcm.ok());
    EXPECT_TRUE((*lcm)->publish("HERE", std::vector<std::uint8_t>{1}));
    EXPECT_TRUE((*lcm)->check_log().ok());
    EXPECT_EQ(std::filesystem::file_size(log), bytes);
  }
  std::filesystem::remove(log);
}

TEST(LcmTransport, KnowsNoLogOfOtherUrls) {
  for (const char* url : {"memq://", "file:///dev/null?mode=w"}) {
    const auto lcm = LcmTransport::open(url);
    ASSERT_TRUE(lcm.ok());
    EXPECT_TRUE((*lcm)->publish("HERE", std::vector<std::uint8_t>{1}));
    EXPECT_TRUE((*lcm)->check_log().ok());
  }
}

TEST(LcmTransport, SaysNothingOfAnAbsentServerHoweverMuchIsPublished) {
  testing::internal::CaptureStderr();
  const auto lcm = LcmTransport::open("tcpq://127.0.0.1:1");
  ASSERT_TRUE(lcm.ok());
  (*lcm)->listen("HERE", [](auto /*bytes*/) {});
  for (int i = 0; i < 100; ++i) EXPECT_FALSE((*lcm)->publish("HERE", std::vector<std::uint8_t>{1}));
  EXPECT_EQ(errno, ENOTCONN);
  EXPECT_FALSE((*lcm)->receive(milliseconds(1)));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// A server of tcpq:// that never reads. Connections wait in the kernel's queue until it greets.
class StalledServer {
 public:
  explicit StalledServer(bool greets)
      : greets_(greets), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in bound{};
    bound.sin_family = AF_INET;
    bound.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, std::bit_cast<const sockaddr*>(&bound), sizeof bound), 0);
    EXPECT_EQ(::listen(socket_, 16), 0);
    socklen_t size = sizeof bound;
    EXPECT_EQ(::getsockname(socket_, std::bit_cast<sockaddr*>(&bound), &size), 0);
    url_ = "tcpq://127.0.0.1:" + std::to_string(ntohs(bound.sin_port));
    thread_ = std::jthread([this](const std::stop_token& stop) { accept(stop); });
  }
  ~StalledServer() {
    thread_ = {};
    for (const int connection : connections_) ::close(connection);
    ::close(socket_);
  }
  StalledServer(const StalledServer&) = delete;
  StalledServer& operator=(const StalledServer&) = delete;
  [[nodiscard]] const std::string& url() const { return url_; }
  void greet() { greets_ = true; }

 private:
  void accept(const std::stop_token& stop) {
    constexpr std::array<std::uint8_t, 8> kGreeting{0x28, 0x76, 0x17, 0xFA, 0, 0, 1, 0};
    while (!stop.stop_requested()) {
      pollfd wait{.fd = socket_, .events = POLLIN, .revents = 0};
      if (::poll(&wait, greets_ ? 1 : 0, 20) != 1) continue;
      connections_.push_back(::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC));
      ::send(connections_.back(), kGreeting.data(), kGreeting.size(), MSG_NOSIGNAL);
    }
  }

  std::atomic<bool> greets_;
  int socket_;
  std::string url_;
  std::vector<int> connections_;
  std::jthread thread_;
};

TEST(LcmServer, IsReachedByItsAddressWhereTheUrlHasAName) {
  StalledServer server(false);
  const std::string port = server.url().substr(server.url().rfind(':'));
  std::optional<LcmServer> named = LcmServer::of_url("tcpq://localhost" + port, kPatience);
  ASSERT_TRUE(named.has_value());
  EXPECT_FALSE(named->is_there()) << "nobody waits for the look";
  server.greet();
  named->wait_for_look();
  ASSERT_TRUE(named->is_there());
  EXPECT_EQ(named->numeric_url(), server.url());
}

TEST(LcmTransport, AServerThatNeverReadsIsLeft) {
  const StalledServer server(true);
  const auto lcm = LcmTransport::open(server.url(), kPatience);
  ASSERT_TRUE(lcm.ok());
  const std::vector<std::uint8_t> message(60'000);
  int taken = 0;
  while (taken < 10'000 && (*lcm)->publish("HERE", message)) ++taken;
  EXPECT_EQ(errno, ENOTCONN);
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, 10'000);
}

TEST(LcmTransport, AServerThatNeverAnswersIsAbsent) {
  const StalledServer server(false);
  const auto lcm = LcmTransport::open(server.url());
  ASSERT_TRUE(lcm.ok());
  EXPECT_FALSE((*lcm)->publish("HERE", std::vector<std::uint8_t>{1}));
  EXPECT_EQ(errno, ENOTCONN);
}

std::string refusal_of(const std::string& url) {
  const auto lcm = LcmTransport::open(url);
  return lcm ? "opened" : lcm.error().message;
}

TEST(LcmTransport, RefusesAUrlThatLcmDoesNotKnow) {
  EXPECT_THAT(refusal_of("mqtt://here"), HasSubstr("'mqtt://here': must begin with udpm://"));
  EXPECT_THAT(refusal_of("udpm://1.2.3.4:7667"), HasSubstr("'1.2.3.4' is no multicast address"));
  EXPECT_THAT(refusal_of("udpm://239.255.76.67:7667?ttl=300"), HasSubstr("ttl must be"));
}

TEST(LcmTransport, TheDoctorIsNotAskedAboutAFile) {
  EXPECT_THAT(refusal_of("file:///proc/nowhere/run.lcm?mode=w"),
              AllOf(HasSubstr("LCM could not open it"), Not(HasSubstr("doctor"))));
}

}  // namespace
}  // namespace swiftlet
