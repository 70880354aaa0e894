// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/udp_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"
#include "tests/firmware_link/scripted_uplink.hpp"
#include "tests/firmware_link/udp_peer.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/thread_cpu_time.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kPatienceMs = 5000;
const Bytes kRegistration = hex("f3");
const Bytes kNull = hex("ff");

std::unique_ptr<UdpLink> open_link(std::uint16_t port, LinkClock& clock) {
  Result<std::unique_ptr<UdpLink>> link = UdpLink::open("127.0.0.1", port, clock);
  SWIFTLET_CHECK(link.ok(), "a loopback address needs no looking up");
  return std::move(link).value();
}

/// A link in time that passes only while it waits, and its peer.
struct Pair {
  UdpPeer peer;
  ManualLinkClock clock;
  std::unique_ptr<UdpLink> link = open_link(peer.port(), clock);

  /// What the link delivers now.
  [[nodiscard]] std::optional<LinkFrame> look() const {
    const Result<LinkFrame> frame = link->receive(Duration::zero());
    if (frame) return *frame;
    EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
    return std::nullopt;
  }
  /// As many datagrams as are expected, and whatever else is there then.
  std::vector<Bytes> received(std::size_t expected) {
    std::vector<Bytes> all;
    while (const std::optional<Bytes> one = peer.receive(all.size() < expected ? kPatienceMs : 0))
      all.push_back(*one);
    return all;
  }
  void connect() {
    EXPECT_FALSE(look().has_value());
    EXPECT_THAT(received(2), ElementsAre(kRegistration, kNull));
    peer.send(hex("f3"));
    EXPECT_FALSE(look().has_value());
    EXPECT_EQ(link->statistics().condition, LinkCondition::kConnected);
  }
};

Bytes bytes_of(const LinkFrame& frame) { return {frame.packet().begin(), frame.packet().end()}; }

TEST(UdpLink, RegistersEvery200MillisecondsWhileNothingIsReceived) {
  Pair pair;
  EXPECT_EQ(pair.link->statistics().condition, LinkCondition::kSilent);
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_THAT(pair.received(2), ElementsAre(kRegistration, kNull));
  pair.clock.sleep_for(milliseconds(199));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_THAT(pair.received(0), ElementsAre());
  pair.clock.sleep_for(milliseconds(1));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_THAT(pair.received(2), ElementsAre(kRegistration, kNull));
  EXPECT_EQ(pair.link->statistics().condition, LinkCondition::kSilent);
  EXPECT_EQ(pair.link->statistics().packets_sent, 4U);
  EXPECT_EQ(pair.link->statistics().packets_acked, 0U);
}

TEST(UdpLink, SendsANullPacketAfter100MillisecondsOfSendingNothing) {
  Pair pair;
  pair.connect();
  pair.clock.sleep_for(milliseconds(60));
  ASSERT_TRUE(pair.link->send(hex("5c 03")).ok());
  EXPECT_TRUE(pair.look().has_value());
  EXPECT_THAT(pair.received(1), ElementsAre(hex("5c 03")));
  pair.clock.sleep_for(milliseconds(99));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_THAT(pair.received(0), ElementsAre());
  pair.clock.sleep_for(milliseconds(1));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_THAT(pair.received(1), ElementsAre(kNull));
}

TEST(UdpLink, AClientsPacketsGoFirstAndDoNotKeepTheVehiclesWaiting) {
  Pair pair;
  pair.connect();
  ScriptedUplink client({0x3C, 1}, 1000);
  pair.link->uplink()->share_with(client);
  ASSERT_TRUE(pair.link->send(hex("5d 05")).ok());
  for (int i = 0; i < 5; ++i) pair.peer.send(hex("52 01 00 00 00"));
  for (int i = 0; i < 10; ++i) {
    const std::optional<LinkFrame> frame = pair.look();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->is_ours, i % 2 == 1);
    EXPECT_EQ(frame->direction, i % 2 == 1 ? LinkDirection::kFromVehicle : LinkDirection::kToVehicle);
  }
  client.left = 0;
  EXPECT_TRUE(pair.look()->is_ours);
}

TEST(UdpLink, DeliversARequestBeforeItsAnswer) {
  Pair pair;
  pair.connect();
  ASSERT_TRUE(pair.link->send(hex("5d 05")).ok());
  ASSERT_TRUE(pair.link->send(hex("5c 03")).ok());
  EXPECT_THAT(pair.received(0), ElementsAre()) << "only receive() sends";
  pair.peer.send(hex("5d 05 00 00"));
  std::vector<LinkFrame> frames;
  while (const std::optional<LinkFrame> frame = pair.look()) {
    frames.push_back(*frame);
    pair.clock.sleep_for(milliseconds(1));
  }
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(bytes_of(frames[0]), hex("5d 05"));
  EXPECT_EQ(bytes_of(frames[1]), hex("5c 03"));
  EXPECT_EQ(bytes_of(frames[2]), hex("5d 05 00 00"));
  EXPECT_EQ(frames[0].direction, LinkDirection::kToVehicle);
  EXPECT_EQ(frames[1].direction, LinkDirection::kToVehicle);
  EXPECT_EQ(frames[2].direction, LinkDirection::kFromVehicle);
  EXPECT_EQ(frames[1].at - frames[0].at, milliseconds(1));
  EXPECT_EQ(frames[2].at - frames[1].at, milliseconds(1));
  EXPECT_THAT(pair.received(2), ElementsAre(hex("5d 05"), hex("5c 03")));
}

TEST(UdpLink, RefusesAnInvalidRequest) {
  Pair pair;
  pair.connect();
  for (const Bytes& packet : {Bytes{}, Bytes(32, 0x5C), hex("ff fe 01")}) {
    const Status sent = pair.link->send(packet);
    ASSERT_FALSE(sent.ok());
    EXPECT_EQ(sent.error().code, ErrorCode::kInvalidInput);
  }
}

TEST(UdpLink, DropsRequestsWithoutRoom) {
  Pair pair;
  pair.connect();
  for (std::uint8_t i = 0; i <= RequestQueue::kCapacity; ++i)
    EXPECT_TRUE(pair.link->send(Bytes{0x5C, i}).ok());
  for (std::uint8_t i = 0; i < RequestQueue::kCapacity; ++i) {
    const std::optional<LinkFrame> frame = pair.look();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(bytes_of(*frame), (Bytes{0x5C, i}));
  }
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.received(RequestQueue::kCapacity).size(), RequestQueue::kCapacity);
}

TEST(UdpLink, DoesNotDeliverNullPacketsAndWrongSizes) {
  Pair pair;
  pair.connect();
  pair.peer.send({});
  pair.peer.send(hex("f7"));
  pair.peer.send(hex("f3 01 2d"));
  pair.peer.send(Bytes(32, 0x52));
  pair.peer.send(Bytes(1500, 0x52));
  pair.peer.send(Bytes(31, 0x52));
  const std::optional<LinkFrame> frame = pair.look();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(bytes_of(*frame), Bytes(31, 0x52));
  EXPECT_EQ(frame->direction, LinkDirection::kFromVehicle);
  EXPECT_EQ(frame->at, pair.clock.now());
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().packets_received, 1U);
}

TEST(UdpLink, KeepsABurstThatComesWhileNobodyReads) {
  constexpr int kBurst = 400;
  Pair pair;
  pair.connect();
  for (int i = 0; i < kBurst; ++i) pair.peer.send(hex("52 01 00 00 00 00"));
  int delivered = 0;
  while (pair.look()) ++delivered;
  EXPECT_EQ(delivered, kBurst);
}

TEST(UdpLink, StampsAFrameWithItsTimeOfArrivalHoweverLateItIsRead) {
  SystemLinkClock clock;
  UdpPeer peer;
  const std::unique_ptr<UdpLink> link = open_link(peer.port(), clock);
  EXPECT_FALSE(link->receive(Duration::zero()).ok());
  EXPECT_TRUE(peer.receive(kPatienceMs).has_value());
  bool is_stamped = false;  // the kernel may take a while until it stamps what comes
  for (int i = 0; i < 500 && !is_stamped; ++i) {
    peer.send(hex("52 01 00 00 00"));
    const HostTime said_at = clock.now();
    std::this_thread::sleep_for(milliseconds(60));
    const Result<LinkFrame> frame = link->receive(milliseconds(kPatienceMs));
    ASSERT_TRUE(frame.ok());
    is_stamped = clock.now() - frame->at >= milliseconds(50) && frame->at - said_at < milliseconds(10);
  }
  EXPECT_TRUE(is_stamped);
}

TEST(UdpLink, IsSilentAfterASecondWithoutADatagramAndReconnects) {
  Pair pair;
  pair.connect();
  pair.clock.sleep_for(milliseconds(999));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().condition, LinkCondition::kConnected);
  EXPECT_THAT(pair.received(1), ElementsAre(kNull));
  pair.clock.sleep_for(milliseconds(1));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().condition, LinkCondition::kSilent);
  EXPECT_THAT(pair.received(2), ElementsAre(kRegistration, kNull));
  pair.clock.sleep_for(std::chrono::minutes(5));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().silences, 1U);

  pair.peer.send(hex("52 01 00 00 00"));
  EXPECT_TRUE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().condition, LinkCondition::kConnected);
  pair.clock.sleep_for(std::chrono::seconds(1));
  EXPECT_FALSE(pair.look().has_value());
  EXPECT_EQ(pair.link->statistics().silences, 2U);
}

TEST(UdpLink, SaysGoodbyeAtItsEnd) {
  Pair pair;
  pair.connect();
  pair.link.reset();
  EXPECT_THAT(pair.received(1), ElementsAre(hex("f4")));
}

TEST(UdpLink, WaitsUntilAVehicleListens) {
  SystemLinkClock clock;
  auto peer = std::make_unique<UdpPeer>();
  const std::uint16_t port = peer->port();
  const std::unique_ptr<UdpLink> link = open_link(port, clock);
  peer.reset();
  const HostTime start = clock.now();
  const Duration cpu_start = thread_cpu_time();
  for (int i = 1; i <= 3; ++i) {
    const Result<LinkFrame> frame = link->receive(milliseconds(250));
    ASSERT_FALSE(frame.ok());
    EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
    EXPECT_GE(clock.now() - start, milliseconds(250) * i);
  }
  EXPECT_LT(thread_cpu_time() - cpu_start, milliseconds(100));
  EXPECT_EQ(link->statistics().condition, LinkCondition::kSilent);
  EXPECT_EQ(link->statistics().silences, 0U);

  peer = std::make_unique<UdpPeer>(port);
  EXPECT_FALSE(link->receive(milliseconds(250)).ok());
  EXPECT_EQ(peer->receive(kPatienceMs), kRegistration);
  peer->send(hex("52 01 00 00 00"));
  EXPECT_TRUE(link->receive(milliseconds(kPatienceMs)).ok());
}

TEST(UdpLink, LosesNoRequestToARefusalOfAnEarlierDatagram) {
  ManualLinkClock clock;
  auto peer = std::make_unique<UdpPeer>();
  const std::uint16_t port = peer->port();
  const std::unique_ptr<UdpLink> link = open_link(port, clock);
  peer.reset();
  EXPECT_FALSE(link->receive(Duration::zero()).ok());  // no vehicle answers
  peer = std::make_unique<UdpPeer>(port);
  ASSERT_TRUE(link->send(hex("5c 03")).ok());
  EXPECT_TRUE(link->receive(Duration::zero()).ok());
  EXPECT_EQ(peer->receive(kPatienceMs), hex("5c 03"));
}

TEST(UdpLink, WakesWhenADatagramArrives) {
  SystemLinkClock clock;
  UdpPeer peer;
  const std::unique_ptr<UdpLink> link = open_link(peer.port(), clock);
  EXPECT_FALSE(link->receive(Duration::zero()).ok());
  EXPECT_TRUE(peer.receive(kPatienceMs).has_value());
  std::thread speaker([&peer] {
    std::this_thread::sleep_for(milliseconds(30));
    peer.send(hex("f3"));
    peer.send(hex("52 01 00 00 00"));
  });
  const HostTime start = clock.now();
  const Result<LinkFrame> frame = link->receive(std::chrono::minutes(1));
  speaker.join();
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(bytes_of(*frame), hex("52 01 00 00 00"));
  EXPECT_LT(frame->at - start, std::chrono::seconds(30));
}

TEST(UdpLink, KeepsTheVehicleConnectedWithinOneLongReceive) {
  Pair pair;
  pair.connect();
  EXPECT_FALSE(pair.link->receive(milliseconds(350)).ok());
  EXPECT_THAT(pair.received(3), ElementsAre(kNull, kNull, kNull));
}

TEST(UdpLink, TakesTheIpv4AddressOfANameWithBoth) {
  UdpPeer peer;
  ManualLinkClock clock;
  const auto link = UdpLink::open("localhost", peer.port(), clock);
  ASSERT_TRUE(link.ok()) << link.error().message;
  EXPECT_FALSE((*link)->receive(Duration::zero()).ok());
  EXPECT_EQ(peer.receive(kPatienceMs), kRegistration);
}

TEST(UdpLink, ReportsAnUnknownHost) {
  ManualLinkClock clock;
  const std::string name(64, 'x');  // longer than a name may be: refused without a name server
  const auto link = UdpLink::open(name, 19850, clock);
  ASSERT_FALSE(link.ok());
  EXPECT_EQ(link.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(link.error().message, HasSubstr("udp://" + name + ": no such host"));
}

TEST(UdpLink, AllocatesNothingOnceOpen) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  Pair pair;
  const Bytes request = hex("5c 03");
  const Bytes answer = hex("52 01 00 00 00");
  pair.connect();
  std::size_t frames = 0;
  const test::AllocationCounter counter;
  for (int i = 0; i < 20; ++i) {
    pair.clock.sleep_for(milliseconds(i < 10 ? 100 : 2000));
    static_cast<void>(pair.link->send(request));
    pair.peer.send(answer);
    for (int look = 0; look < 3; ++look) frames += pair.link->receive(Duration::zero()).ok() ? 1U : 0U;
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_EQ(frames, 40U);
}

}  // namespace
}  // namespace swiftlet
