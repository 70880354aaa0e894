// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/benchmarks/fault_relay.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kLongestGarbage = 64;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

int open_socket() {
  const int opened = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  SWIFTLET_CHECK(opened >= 0, "the system gives a socket");
  return opened;
}

}  // namespace

bool RelayFaults::set(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) return false;
  const std::string name = assignment.substr(0, equals);
  const double value = std::strtod(assignment.c_str() + equals + 1, nullptr);
  struct Row {
    const char* name;
    double RelayFaults::*value;
  };
  constexpr std::array kRows{Row{"loss", &RelayFaults::loss},
                             Row{"duplicates", &RelayFaults::duplicates},
                             Row{"delay_ms", &RelayFaults::delay_ms},
                             Row{"jitter_ms", &RelayFaults::jitter_ms},
                             Row{"truncation", &RelayFaults::truncation},
                             Row{"bit_flips", &RelayFaults::bit_flips},
                             Row{"garbage_hz", &RelayFaults::garbage_hz},
                             Row{"outage_every_s", &RelayFaults::outage_every_s},
                             Row{"outage_s", &RelayFaults::outage_s}};
  const auto row = std::ranges::find(kRows, name, &Row::name);
  if (row == kRows.end()) return false;
  this->*row->value = value;
  return true;
}

FaultRelay::FaultRelay(std::uint16_t server_port, const RelayFaults& faults, std::uint64_t seed)
    : faults_(faults), random_(seed), front_(open_socket()), back_(open_socket()) {
  const sockaddr_in any = loopback(0);
  const sockaddr_in server = loopback(server_port);
  const bool is_bound = ::bind(front_, std::bit_cast<const sockaddr*>(&any), sizeof any) == 0;
  const bool is_connected = ::connect(back_, std::bit_cast<const sockaddr*>(&server), sizeof server) == 0;
  SWIFTLET_CHECK(is_bound && is_connected, "the loopback has free ports");
}

FaultRelay::~FaultRelay() {
  ::close(front_);
  ::close(back_);
}

std::uint16_t FaultRelay::port() const {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  ::getsockname(front_, std::bit_cast<sockaddr*>(&bound), &size);
  return ntohs(bound.sin_port);
}

void FaultRelay::serve(HostTime now) {
  take_from(front_, false, now);
  take_from(back_, true, now);
  send_due(now);
  if (faults_.garbage_hz > 0.0) send_garbage(now);
}

double FaultRelay::seconds_at(HostTime now) {
  if (!began_at_) began_at_ = now;
  return to_seconds(now - *began_at_);
}

void FaultRelay::take_from(int socket, bool to_client, HostTime now) {
  std::array<std::uint8_t, 128> buffer{};
  for (;;) {
    sockaddr_in from{};
    socklen_t from_size = sizeof from;
    const ssize_t size =
        ::recvfrom(socket, buffer.data(), buffer.size(), 0, std::bit_cast<sockaddr*>(&from), &from_size);
    if (size < 0) return;
    if (!to_client) client_ = from;
    pass({buffer.begin(), buffer.begin() + size}, to_client, now);
  }
}

void FaultRelay::pass(Bytes bytes, bool to_client, HostTime now) {
  const double passed_s = seconds_at(now);
  const bool is_out = faults_.outage_every_s > 0.0 &&
                      std::fmod(passed_s, faults_.outage_every_s) > faults_.outage_every_s - faults_.outage_s;
  if (is_out || chance(faults_.loss) || bytes.empty()) return;
  if (chance(faults_.truncation)) bytes.resize(draw_below(bytes.size()));
  if (!bytes.empty() && chance(faults_.bit_flips))
    bytes[draw_below(bytes.size())] ^= static_cast<std::uint8_t>(1U << draw_below(8));
  const int copies = chance(faults_.duplicates) ? 2 : 1;
  for (int i = 0; i < copies; ++i) {
    const double late_ms =
        faults_.delay_ms + faults_.jitter_ms * std::uniform_real_distribution<double>(0.0, 1.0)(random_);
    flying_.push({now + from_seconds(late_ms / 1000.0), number_++, to_client, bytes});
  }
}

void FaultRelay::send_due(HostTime now) {
  for (; !flying_.empty() && flying_.top().due <= now; flying_.pop())
    send(flying_.top().bytes, flying_.top().to_client);
}

void FaultRelay::send_garbage(HostTime now) {
  const auto owed = static_cast<std::uint64_t>(seconds_at(now) * faults_.garbage_hz);
  Bytes bytes;
  for (; client_ && garbage_sent_ < owed; ++garbage_sent_) {
    bytes.resize(1 + draw_below(kLongestGarbage));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    send(bytes, true);
  }
}

/// Errors are ignored: a full socket loses datagrams, as networks do.
void FaultRelay::send(const Bytes& bytes, bool to_client) const {
  if (!to_client) {
    static_cast<void>(::send(back_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
  } else if (client_) {
    static_cast<void>(::sendto(front_, bytes.data(), bytes.size(), MSG_NOSIGNAL,
                               std::bit_cast<const sockaddr*>(&*client_), sizeof *client_));
  }
}

}  // namespace swiftlet
