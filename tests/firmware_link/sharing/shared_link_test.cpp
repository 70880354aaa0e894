// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/shared_link.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <array>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "firmware_link/link/link_packet.hpp"
#include "firmware_link/link/uplink_queue.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/flight_client.hpp"

namespace swiftlet {
namespace {

using std::chrono::seconds;
using Kind = VehicleEvent::Kind;

/// Sends what it has, and receives every packet that it sent.
class EchoLink final : public Link {
 public:
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    if (echo_)
      return frame_of(LinkDirection::kFromVehicle, {}, bytes_of(*std::exchange(echo_, std::nullopt)));
    static_cast<void>(uplink_.client_waits());
    const std::optional<UplinkQueue::Packet> packet = uplink_.next();
    if (!packet) return Error{ErrorCode::kTimeout, "nothing"};
    echo_ = packet->bytes;
    LinkFrame frame = frame_of(LinkDirection::kToVehicle, {}, bytes_of(packet->bytes));
    frame.is_ours = packet->is_ours;
    return frame;
  }
  Status send(std::span<const std::uint8_t> packet) override { return uplink_.push(packet); }
  LinkStatistics statistics() const override { return {.condition = condition}; }
  UplinkQueue* uplink() override { return &uplink_; }

  LinkCondition condition = LinkCondition::kConnected;

 private:
  UplinkQueue uplink_;
  std::optional<CrtpPacket> echo_;
};

class SharedLinkTest : public testing::Test {
 protected:
  void SetUp() override {
    auto socket = ClientSocket::open({.host = "localhost", .port = 0});
    ASSERT_TRUE(socket.ok());
    auto echo = std::make_unique<EchoLink>();
    echo_ = echo.get();
    link_.emplace(std::move(echo), std::move(*socket), clock_);
    EXPECT_TRUE(link_->send(bytes_of(log_reset_request())).ok());
    static_cast<void>(pass());
    client_ = std::make_unique<FlightClient>(link_->port());
  }
  /// What passes until there is nothing.
  std::vector<LinkFrame> pass() {
    std::vector<LinkFrame> frames;
    for (Result<LinkFrame> frame = link_->receive({}); frame; frame = link_->receive({}))
      frames.push_back(*frame);
    return frames;
  }
  std::vector<Kind> events() {
    std::vector<Kind> kinds;
    while (const std::optional<VehicleEvent> event = link_->take_event()) kinds.push_back(event->kind);
    return kinds;
  }
  template <std::size_t kSize>
  void send(const std::array<std::uint8_t, kSize>& bytes) {
    client_->send(bytes);
  }

  ManualLinkClock clock_;
  EchoLink* echo_ = nullptr;
  std::optional<SharedLink> link_;
  std::unique_ptr<FlightClient> client_;
};

TEST_F(SharedLinkTest, DeliversTheClientsPacketsMarkedAndTheVehiclesToTheClient) {
  client_->ask(param_read_request(7));
  client_->step(clock_.now());
  const std::vector<LinkFrame> frames = pass();
  ASSERT_EQ(frames.size(), 4U) << "the ping, the request, and what comes back";
  for (const LinkFrame& frame : frames) EXPECT_FALSE(frame.is_ours);
  client_->step(clock_.now());
  EXPECT_TRUE(client_->is_idle());
  EXPECT_EQ(client_->unanswered(), 0U);
  EXPECT_TRUE(client_->strange().empty());
  EXPECT_EQ(events(), std::vector{Kind::kClientConnected});
  EXPECT_TRUE(link_->sharing().has_client);
}

TEST_F(SharedLinkTest, AHelloIsAnsweredAndAGoodbyeEndsTheClient) {
  constexpr std::array<std::uint8_t, 1> kHello{0xF3};
  constexpr std::array<std::uint8_t, 1> kGoodbye{0xF4};
  send(kHello);
  EXPECT_TRUE(pass().empty());
  EXPECT_TRUE(link_->sharing().has_client);
  send(kGoodbye);
  EXPECT_TRUE(pass().empty());
  EXPECT_FALSE(link_->sharing().has_client);
  EXPECT_EQ(events(), (std::vector{Kind::kClientConnected, Kind::kClientGone}));
}

TEST_F(SharedLinkTest, AStopThatCameJustBeforeTheGoodbyeReachesTheVehicle) {
  constexpr std::array<std::uint8_t, 2> kStop{0x7C, 0};
  constexpr std::array<std::uint8_t, 1> kGoodbye{0xF4};
  send(kStop);
  send(kGoodbye);
  const std::vector<LinkFrame> frames = pass();
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(Bytes(frames[0].packet().begin(), frames[0].packet().end()), Bytes(kStop.begin(), kStop.end()));
  EXPECT_FALSE(link_->sharing().has_client);
}

TEST_F(SharedLinkTest, AScanIsAnsweredWhileTheVehicleIsReceivedAndMakesNoClient) {
  constexpr std::array<std::uint8_t, 1> kScan{0xFF};
  send(kScan);
  EXPECT_TRUE(pass().empty());
  client_->step(clock_.now());
  EXPECT_EQ(client_->nulls(), 1U);
  EXPECT_FALSE(link_->sharing().has_client);
  echo_->condition = LinkCondition::kSilent;
  FlightClient scanner(link_->port());
  scanner.send(kScan);
  EXPECT_TRUE(pass().empty());
  EXPECT_EQ(scanner.nulls(), 0U);
}

TEST_F(SharedLinkTest, AClientThatFallsSilentIsGone) {
  client_->step(clock_.now());
  static_cast<void>(pass());
  clock_.sleep_for(ClientSocket::kSilence - seconds(1));
  static_cast<void>(pass());
  EXPECT_TRUE(link_->sharing().has_client);
  clock_.sleep_for(seconds(1));
  static_cast<void>(pass());
  EXPECT_FALSE(link_->sharing().has_client);
}

TEST_F(SharedLinkTest, TheNextClientHasThePlaceOfOneThatHasClosedItsSocket) {
  client_->step(clock_.now());
  static_cast<void>(pass());
  client_->send(param_read_request(7));
  client_.reset();
  EXPECT_EQ(pass().size(), 2U) << "what it sent last still passes";
  EXPECT_EQ(events(), std::vector{Kind::kClientConnected});
  FlightClient next(link_->port());
  next.ask(source_request());
  next.step(clock_.now());
  EXPECT_EQ(pass().size(), 4U) << "a ping, the request, and what comes back";
  EXPECT_EQ(events(), (std::vector{Kind::kClientGone, Kind::kClientConnected}));
  next.step(clock_.now());
  EXPECT_TRUE(next.is_idle());
  EXPECT_EQ(next.unanswered(), 0U);
}

TEST_F(SharedLinkTest, RequestsWaitForAVehicleThatIsNotReceivedSetpointsDoNot) {
  echo_->condition = LinkCondition::kSilent;
  client_->send(param_read_request(7));
  send(std::array<std::uint8_t, 2>{0x3C, 1});
  EXPECT_TRUE(pass().empty());
  echo_->condition = LinkCondition::kConnected;
  const std::vector<LinkFrame> frames = pass();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].packet()[0], 0x2D);
  EXPECT_EQ(link_->sharing().counters.steering_dropped, 1U);
}

TEST_F(SharedLinkTest, NothingIsSentAgainOfAClientThatIsGone) {
  echo_->uplink()->take_back(param_read_request(7));
  EXPECT_TRUE(pass().empty());
}

TEST_F(SharedLinkTest, TellsOncePerRefusedClientHoweverTheySendInTurn) {
  client_->step(clock_.now());
  static_cast<void>(pass());
  EXPECT_EQ(events(), std::vector{Kind::kClientConnected});
  FlightClient first(link_->port());
  FlightClient second(link_->port());
  std::size_t told = 0;
  for (int i = 0; i < 5; ++i) {
    first.send(param_read_request(7));
    second.send(param_read_request(7));
    static_cast<void>(pass());
    told += events().size();
  }
  EXPECT_EQ(told, 2U);
  for (int i = 0; i < 20; ++i) {
    FlightClient(link_->port()).send(param_read_request(7));
    static_cast<void>(pass());
    told += events().size();
  }
  EXPECT_LE(told, 8U);
}

TEST_F(SharedLinkTest, AtTheEndTheClientIsToldAndRefused) {
  client_->step(clock_.now());
  static_cast<void>(pass());
  link_->end_sharing();
  client_->step(clock_.now());
  EXPECT_EQ(client_->console(), "swiftletd has ended\n");
  EXPECT_FALSE(link_->sharing().has_client);
  EXPECT_TRUE(pass().empty());
}

TEST_F(SharedLinkTest, ServesWithoutTheHeap) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  constexpr std::array<std::uint8_t, 15> kSetpoint{0x3C};
  constexpr std::array<std::uint8_t, 6> kCreate{0x5D, 6, 1, 7, 0, 0};
  constexpr std::array<std::uint8_t, 2> kReset{0x5D, 5};
  constexpr std::array<std::uint8_t, 3> kRead{0x2D, 1, 0};
  std::size_t frames = 0;
  const test::AllocationCounter counter;
  for (int i = 0; i < 100; ++i) {
    send(kSetpoint);
    send(kCreate);
    send(kRead);
    send(kReset);
    while (link_->receive({})) ++frames;
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GE(frames, 200U);
}

TEST(ClientSocketTest, DoesNotStayReadableWhenAnAnswerFindsNobody) {
  const auto socket = ClientSocket::open({.host = "127.0.0.1", .port = 0});
  ASSERT_TRUE(socket.ok());
  constexpr std::array<std::uint8_t, 1> kScan{0xFF};
  FlightClient((*socket)->port()).send(kScan);
  while ((*socket)->receive({}, true).is_any) continue;
  pollfd watched{.fd = (*socket)->file(), .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&watched, 1, 0), 0);
}

TEST(ClientSocketTest, RefusesWhatIsNoAddressOfThisMachine) {
  EXPECT_FALSE(ClientSocket::open({.host = "pilot", .port = 0}).ok());
  const auto socket = ClientSocket::open({.host = "127.0.0.1", .port = 0});
  ASSERT_TRUE(socket.ok());
  const auto second = ClientSocket::open({.host = "127.0.0.1", .port = (*socket)->port()});
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("another program has it"), std::string::npos);
}

}  // namespace
}  // namespace swiftlet
