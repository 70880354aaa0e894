// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/client_socket.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

using Kind = VehicleEvent::Kind;

constexpr std::array<std::uint8_t, 1> kHello{0xF3};  // also the answer to a null packet
constexpr std::array<std::uint8_t, 1> kGoodbye{0xF4};
constexpr std::uint8_t kConsoleHeader = 0x00;

sockaddr* generic(sockaddr_in* address) { return std::bit_cast<sockaddr*>(address); }
const sockaddr* generic(const sockaddr_in* address) { return std::bit_cast<const sockaddr*>(address); }

bool is_same(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

bool is_byte(std::span<const std::uint8_t> packet, const std::array<std::uint8_t, 1>& byte) {
  return packet.size() == 1 && packet[0] == byte[0];
}

Error no_socket(const std::string& where) {
  const std::string remedy = errno == EADDRINUSE ? "; another program has it, choose another port" : "";
  return {ErrorCode::kInvalidInput, "cannot share on udp://" + where + ": " + std::strerror(errno) + remedy};
}

}  // namespace

Result<std::unique_ptr<ClientSocket>> ClientSocket::open(const UdpAddress& address) {
  const std::string host = address.host == "localhost" ? "127.0.0.1" : address.host;
  const std::string where = host + ":" + std::to_string(address.port);
  sockaddr_in bound{};
  bound.sin_family = AF_INET;
  bound.sin_port = htons(address.port);
  if (inet_pton(AF_INET, host.c_str(), &bound.sin_addr) != 1)
    return Error{ErrorCode::kInvalidInput,
                 "cannot share on udp://" + where + ": not an IPv4 address; write " + kLocalUdpUri};
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return no_socket(where);
  const int reports_errors = 1;
  const bool is_set = setsockopt(socket, IPPROTO_IP, IP_RECVERR, &reports_errors, sizeof reports_errors) == 0;
  if (is_set && bind(socket, generic(&bound), sizeof bound) == 0)
    return std::unique_ptr<ClientSocket>(new ClientSocket(socket));
  const Error error = no_socket(where);
  ::close(socket);
  return error;
}

void ClientSocket::close() {
  if (socket_ < 0) return;
  print("swiftletd has ended\n");
  client_.reset();
  ::close(socket_);
  socket_ = -1;
}

std::uint16_t ClientSocket::port() const {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(socket_, generic(&bound), &size);
  return ntohs(bound.sin_port);
}

ClientSocket::Arrival ClientSocket::receive(HostTime now, bool is_connected) {
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  const ssize_t size = recvfrom(socket_, buffer_.data(), buffer_.size(), 0, generic(&from), &from_size);
  if (size < 0) {
    const bool is_any = errno != EAGAIN && socket_ >= 0;
    if (is_any) drop_errors();
    return {.is_any = is_any, .packet = {}};
  }
  const std::span<const std::uint8_t> packet(buffer_.data(), static_cast<std::size_t>(size));
  if (packet.empty() || packet.size() > kMaxCrtpPacket) return {.is_any = true, .packet = {}};
  if (!client_ || !is_same(*client_, from)) return on_strangers(packet, from, now, is_connected);
  received_at_ = now;
  return on_clients(packet, is_connected);
}

ClientSocket::Arrival ClientSocket::on_clients(std::span<const std::uint8_t> packet, bool is_connected) {
  if (is_byte(packet, kGoodbye)) {
    lose_client();
    return {.is_any = true, .ended = true, .packet = {}};
  }
  if (!is_null_packet(packet)) return {.is_any = true, .packet = packet};
  if (is_connected) send(kHello);
  return {.is_any = true, .packet = {}};
}

ClientSocket::Arrival ClientSocket::on_strangers(std::span<const std::uint8_t> packet,
                                                 const sockaddr_in& from, HostTime now, bool is_connected) {
  const bool is_scan = is_null_packet(packet) && !is_byte(packet, kHello);
  if (is_byte(packet, kGoodbye) || (client_ && is_scan)) return {.is_any = true, .packet = {}};
  if (is_scan) {
    if (is_connected) send(kHello, from);
    return {.is_any = true, .packet = {}};
  }
  const bool replaces = client_.has_value();
  if (replaces && !client_has_closed()) {
    refuse(from);
    return {.is_any = true, .packet = {}};
  }
  if (replaces) lose_client();
  client_ = from;
  received_at_ = now;
  report(Kind::kClientConnected, ntohs(from.sin_port));
  Arrival arrival = on_clients(packet, is_connected);
  arrival.ended = replaces;
  return arrival;
}

/// The vendor's client closes its socket without a goodbye, and connects again from another port. On this
/// machine the system refuses at once what is sent to a closed one.
bool ClientSocket::client_has_closed() const {
  drop_errors();
  send(kHello);
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
  drop_errors();
  return error == ECONNREFUSED;
}

/// Those of datagrams that nobody took: until they are read, the socket looks as if something had arrived.
void ClientSocket::drop_errors() const {
  while (recv(socket_, nullptr, 0, MSG_ERRQUEUE) >= 0) continue;
}

/// One line for each of the first ones, not for each of their packets.
void ClientSocket::refuse(const sockaddr_in& from) {
  for (const sockaddr_in& before : refused_)
    if (is_same(before, from)) return;
  if (!refused_.try_push_back(from)) return;
  report(Kind::kClientRefused, ntohs(from.sin_port));
}

bool ClientSocket::has_fallen_silent(HostTime now) {
  if (!client_ || now - received_at_ < kSilence) return false;
  lose_client();
  return true;
}

void ClientSocket::lose_client() {
  client_.reset();
  refused_.clear();
  report(Kind::kClientGone);
}

void ClientSocket::report_lost_blocks() {
  if (!client_) return;
  print("swiftletd: the log had to begin anew, your blocks are gone; connect again\n");
  report(Kind::kClientBlocksLost);
}

/// In pieces, as the vehicle does.
void ClientSocket::print(std::string_view line) {
  while (!line.empty()) {
    CrtpPacket packet;
    static_cast<void>(packet.try_push_back(kConsoleHeader));
    while (!line.empty() && packet.try_push_back(static_cast<std::uint8_t>(line.front())))
      line.remove_prefix(1);
    send(bytes_of(packet));
  }
}

void ClientSocket::send(std::span<const std::uint8_t> packet) const {
  if (client_) send(packet, *client_);
}

void ClientSocket::send(std::span<const std::uint8_t> packet, const sockaddr_in& to) const {
  // The error of an earlier datagram fails this call, not this datagram.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (sendto(socket_, packet.data(), packet.size(), MSG_NOSIGNAL, generic(&to), sizeof to) >= 0) return;
    if (errno == EAGAIN) return;
    drop_errors();
  }
}

std::optional<VehicleEvent> ClientSocket::take_event() {
  if (events_.empty()) return std::nullopt;
  const VehicleEvent event = events_.front();
  events_.erase_front(1);
  return event;
}

void ClientSocket::report(Kind kind, std::int32_t value) {
  static_cast<void>(events_.try_push_back({kind, value}));
}

}  // namespace swiftlet
