// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/udp_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>

#include "firmware_link/link/udp_address.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kIdle = 0xF3;  // the acknowledgement of a vehicle that has nothing to send

sockaddr* generic(sockaddr_in* address) { return std::bit_cast<sockaddr*>(address); }
const sockaddr* generic(const sockaddr_in* address) { return std::bit_cast<const sockaddr*>(address); }

std::string text_of(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(ntohs(address.sin_port));
}

bool is_same(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

bool is_null(std::span<const std::uint8_t> packet) { return (packet[0] & 0xF3U) == 0xF3U; }

Error no_socket(const std::string& where) {
  const std::string remedy = errno == EADDRINUSE ? "; another program has it, choose another port" : "";
  return {ErrorCode::kInvalidInput, "cannot listen on udp " + where + ": " + std::strerror(errno) + remedy};
}

}  // namespace

Result<std::unique_ptr<SimulatedUdpServer>> SimulatedUdpServer::open(const std::string& host,
                                                                     std::uint16_t port,
                                                                     SimulatedVehicle& vehicle,
                                                                     LinkClock& clock, std::uint64_t seed) {
  const std::string where = host + ":" + std::to_string(port);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
    return Error{ErrorCode::kInvalidInput,
                 "cannot listen on udp " + where + ": not an IPv4 address; write " + kLocalUdpAddress};
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return no_socket(where);
  if (bind(socket, generic(&address), sizeof address) != 0) {
    const Error error = no_socket(where);
    close(socket);
    return error;
  }
  return std::unique_ptr<SimulatedUdpServer>(new SimulatedUdpServer(socket, vehicle, clock, seed));
}

SimulatedUdpServer::SimulatedUdpServer(int socket, SimulatedVehicle& vehicle, LinkClock& clock,
                                       std::uint64_t seed)
    : socket_(socket),
      vehicle_(vehicle),
      clock_(clock),
      noise_(seed, "udp"),
      began_at_(clock.now()),
      vehicle_began_at_(vehicle.now()) {}

SimulatedUdpServer::~SimulatedUdpServer() { close(socket_); }

std::string SimulatedUdpServer::address() const {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  getsockname(socket_, generic(&bound), &size);
  return text_of(bound);
}

std::optional<std::string> SimulatedUdpServer::client() const {
  if (!peer_) return std::nullopt;
  return text_of(*peer_);
}

void SimulatedUdpServer::serve() {
  live_on();
  on_frame();
  send_due();
}

void SimulatedUdpServer::live_on() {
  for (const SentPacket& sent : vehicle_.advance(vehicle_began_at_ + (clock_.now() - began_at_)))
    if (peer_) send(sent.bytes, *peer_);
  if (peer_ && vehicle_.now() - peer_received_at_ > kRadioLinkTimeout) peer_.reset();
}

void SimulatedUdpServer::on_frame() {
  std::array<std::uint8_t, 64> buffer{};
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  while (true) {
    const ssize_t size = recvfrom(socket_, buffer.data(), buffer.size(), 0, generic(&from), &from_size);
    if (size < 0 && errno != EINTR && errno != ECONNREFUSED) return;  // nothing more for now
    if (size <= 0 || static_cast<std::size_t>(size) > kMaxCrtpPacket) continue;
    if (is_silent() || noise_.chance(faults_.loss_share)) continue;
    on_frame(std::span(buffer).first(static_cast<std::size_t>(size)), from);
  }
}

void SimulatedUdpServer::on_frame(std::span<const std::uint8_t> packet, const sockaddr_in& from) {
  if (!vehicle_.is_on_air()) return;
  const bool is_scan = is_null(packet) && !(peer_ && is_same(*peer_, from));
  if (!is_scan) {
    peer_ = from;
    peer_received_at_ = vehicle_.now();
    for (const PacketBytes& answer : vehicle_.handle(packet)) send(answer, from);
  }
  if (!is_null(packet) || packet.size() > 1) return;
  PacketBytes idle;
  put(idle, kIdle);
  send(idle, from);
}

void SimulatedUdpServer::send(const PacketBytes& bytes, const sockaddr_in& to) {
  if (is_silent() || noise_.chance(faults_.loss_share)) return;
  flying_.push_back({clock_.now() + faults_.delay, to, bytes});
  if (noise_.chance(faults_.duplicate_share)) flying_.push_back(flying_.back());
}

/// Errors are ignored: the receiver may be gone.
void SimulatedUdpServer::send_due() {
  while (!flying_.empty() && flying_.front().due <= clock_.now()) {
    const Flying& packet = flying_.front();
    static_cast<void>(
        sendto(socket_, packet.bytes.data(), packet.bytes.size(), 0, generic(&packet.to), sizeof packet.to));
    flying_.pop_front();
  }
}

}  // namespace swiftlet
