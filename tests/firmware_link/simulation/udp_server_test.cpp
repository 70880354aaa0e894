// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/udp_server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <string>
#include <vector>

#include "tests/firmware_link/manual_link_clock.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class Client {
 public:
  explicit Client(const std::string& server) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(server.substr(server.find(':') + 1))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, std::bit_cast<sockaddr*>(&to), sizeof to), 0);
  }
  ~Client() { close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const Bytes& packet) const {
    EXPECT_EQ(::send(socket_, packet.data(), packet.size(), 0), static_cast<ssize_t>(packet.size()));
  }
  /// All that has arrived: datagrams on the loopback are there as soon as they are sent.
  [[nodiscard]] std::vector<Bytes> received() const {
    std::vector<Bytes> packets;
    Bytes buffer(64);
    for (ssize_t size = 0; (size = recv(socket_, buffer.data(), buffer.size(), 0)) > 0;)
      packets.emplace_back(buffer.begin(), buffer.begin() + size);
    return packets;
  }

 private:
  int socket_;
};

VehicleModel on_air() {
  VehicleModel model;
  model.link_timeout = kRadioLinkTimeout;
  return model;
}

class UdpServer : public testing::Test {
 protected:
  UdpServer() : server_(std::move(SimulatedUdpServer::open("127.0.0.1", 0, vehicle_, clock_, 1)).value()) {}

  /// Sends, and what came back.
  std::vector<Bytes> ask(const Client& client, const Bytes& packet) {
    client.send(packet);
    server_->serve();
    return client.received();
  }
  void pass(Duration duration) {
    clock_.sleep_for(duration);
    server_->serve();
  }
  /// One variable every 100 ms as block 1.
  void start_logging(const Client& client) {
    EXPECT_THAT(ask(client, {0x5C | 1, 6, 1, 2, 0, 0}), ElementsAre(Bytes{0x5D, 6, 1, 0}));
    EXPECT_THAT(ask(client, {0x5D, 3, 1, 10}), ElementsAre(Bytes{0x5D, 3, 1, 0}));
  }

  ManualLinkClock clock_;
  SimulatedVehicle vehicle_{make_simulated_world("loop").value(), on_air(), 1};
  std::unique_ptr<SimulatedUdpServer> server_;
  Client client_{server_->address()};
};

TEST_F(UdpServer, AnswersANullPacketOfOneByteAsIdle) {
  EXPECT_THAT(ask(client_, {0xFF}), ElementsAre(Bytes{0xF3}));
  EXPECT_THAT(ask(client_, {0xF3}), ElementsAre(Bytes{0xF3}));
  EXPECT_THAT(ask(client_, {0xFF, 0x05, 0x01}), IsEmpty()) << "safelink is the radio's";
  EXPECT_EQ(server_->client(), std::nullopt) << "a scan is no client";
}

TEST_F(UdpServer, AnswersRequestsAndIgnoresInvalidPackets) {
  EXPECT_THAT(ask(client_, {0xFC, 7}), ElementsAre(Bytes{0xFC, 7}));
  EXPECT_TRUE(server_->client().has_value());
  EXPECT_THAT(ask(client_, Bytes(32, 0xFC)), IsEmpty());
  EXPECT_THAT(ask(client_, {}), IsEmpty());
}

TEST_F(UdpServer, SendsLogDataAtTheClocksPaceToThePollingClient) {
  start_logging(client_);
  std::size_t data = 0;
  for (int i = 0; i < 200; ++i) {
    client_.send({0xFF});
    pass(milliseconds(10));
    for (const Bytes& packet : client_.received()) data += packet[0] == 0x52 ? 1U : 0U;
  }
  EXPECT_GE(data, 19U);
  EXPECT_LE(data, 20U);
}

TEST_F(UdpServer, DropsAClientThatIsGoneAndAcceptsTheNext) {
  start_logging(client_);
  pass(milliseconds(900));
  EXPECT_THAT(client_.received(), SizeIs(testing::Ge(8U)));
  pass(milliseconds(200));
  EXPECT_EQ(server_->client(), std::nullopt);
  const Client next(server_->address());
  EXPECT_THAT(ask(next, {0x5D, 3, 1, 10}), ElementsAre(Bytes{0x5D, 3, 1, 2})) << "the block is gone";
  start_logging(next);
  pass(milliseconds(500));
  EXPECT_THAT(next.received(), SizeIs(testing::Ge(4U)));
}

TEST_F(UdpServer, DropsAClientNoEarlierThanTheVehicleItsBlocks) {
  clock_.sleep_for(std::chrono::microseconds(500));
  start_logging(client_);
  pass(milliseconds(998));
  for (int i = 0; i < 40 && server_->client(); ++i) pass(std::chrono::microseconds(100));
  EXPECT_EQ(server_->client(), std::nullopt);
  const Client next(server_->address());
  EXPECT_THAT(ask(next, {0x5D, 3, 1, 10}), ElementsAre(Bytes{0x5D, 3, 1, 2})) << "the block is gone";
}

TEST_F(UdpServer, KeepsTheStreamDuringAScan) {
  start_logging(client_);
  const Client scanner(server_->address());
  EXPECT_THAT(ask(scanner, {0xFF}), ElementsAre(Bytes{0xF3}));
  pass(milliseconds(300));
  EXPECT_THAT(client_.received(), SizeIs(testing::Ge(2U)));
  EXPECT_THAT(scanner.received(), IsEmpty());
}

TEST_F(UdpServer, KeepsItsConsoleTextForAClient) {
  vehicle_.reset_estimator();  // prints a line
  const Client scanner(server_->address());
  EXPECT_THAT(ask(scanner, {0xFF}), ElementsAre(Bytes{0xF3}));
  pass(milliseconds(300));
  EXPECT_THAT(scanner.received(), IsEmpty());
  EXPECT_THAT(ask(client_, {0xFC, 7}), ElementsAre(Bytes{0xFC, 7}));
  pass(milliseconds(300));
  const std::vector<Bytes> text = client_.received();
  ASSERT_THAT(text, SizeIs(testing::Ge(1U)));
  EXPECT_EQ(std::string(text[0].begin() + 1, text[0].begin() + 10), "ESTKALMAN");
}

TEST_F(UdpServer, AcceptsARestartedClientAtOnce) {
  start_logging(client_);
  const Client restarted(server_->address());
  EXPECT_THAT(ask(restarted, {0x5D, 5}), ElementsAre(Bytes{0x5D, 5, 0, 0}));
  start_logging(restarted);
  pass(milliseconds(300));
  EXPECT_THAT(restarted.received(), SizeIs(testing::Ge(2U)));
  EXPECT_THAT(client_.received(), IsEmpty());
}

TEST_F(UdpServer, LosesDuplicatesAndDelaysAsConfigured) {
  server_->set_faults({.loss_share = 1.0});
  EXPECT_THAT(ask(client_, {0xFC, 1}), IsEmpty());
  server_->set_faults({.duplicate_share = 1.0});
  EXPECT_THAT(ask(client_, {0xFC, 2}), ElementsAre(Bytes{0xFC, 2}, Bytes{0xFC, 2}));
  server_->set_faults({.delay = milliseconds(50)});
  EXPECT_THAT(ask(client_, {0xFC, 3}), IsEmpty());
  pass(milliseconds(49));
  EXPECT_THAT(client_.received(), IsEmpty());
  pass(milliseconds(1));
  EXPECT_THAT(client_.received(), ElementsAre(Bytes{0xFC, 3}));
}

TEST_F(UdpServer, LosesAboutTheGivenShare) {
  server_->set_faults({.loss_share = 0.2});
  std::size_t answered = 0;
  for (int i = 0; i < 1000; ++i) answered += ask(client_, {0xFC, 1}).size();
  EXPECT_NEAR(static_cast<double>(answered), 1000.0 * 0.8 * 0.8, 60.0) << "there and back";
}

TEST_F(UdpServer, IsSilentForTheGivenTime) {
  server_->silence(seconds(3));
  EXPECT_THAT(ask(client_, {0xFC, 1}), IsEmpty());
  pass(seconds(3));
  EXPECT_THAT(ask(client_, {0xFC, 2}), ElementsAre(Bytes{0xFC, 2}));
}

TEST_F(UdpServer, DoesNotAnswerWhileTheVehicleBoots) {
  vehicle_.reboot();
  EXPECT_THAT(ask(client_, {0xFF}), IsEmpty());
  for (int i = 0; i < 45; ++i) pass(milliseconds(100));
  EXPECT_THAT(ask(client_, {0xFF}), testing::Contains(Bytes{0xF3}));
}

TEST_F(UdpServer, ReportsWhyItCannotListen) {
  const std::string address = server_->address();
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.find(':') + 1)));
  const auto second = SimulatedUdpServer::open("127.0.0.1", port, vehicle_, clock_, 1);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message, HasSubstr(address));
  EXPECT_THAT(second.error().message, HasSubstr("another port"));
  const auto nowhere = SimulatedUdpServer::open("nowhere", 1, vehicle_, clock_, 1);
  ASSERT_FALSE(nowhere.ok());
  EXPECT_THAT(nowhere.error().message, HasSubstr("nowhere:1"));
}

}  // namespace
}  // namespace swiftlet
