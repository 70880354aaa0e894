// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/udp_link.hpp"

#include <netdb.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr Duration kRegistrationPeriod = std::chrono::milliseconds(200);
constexpr Duration kMaxSendPause = std::chrono::milliseconds(100);
// Datagrams read without checking the time: a flood of useless ones must not block receive().
constexpr int kMaxAtOnce = 64;
constexpr std::array<std::uint8_t, 1> kRegistration{0xF3};
constexpr std::array<std::uint8_t, 1> kFarewell{0xF4};
constexpr std::array<std::uint8_t, 1> kNullPacket{0xFF};
// A flood must not push the vehicle's packets out meanwhile. The system grants what net.core.rmem_max allows.
constexpr int kSocketBufferBytes = 1 << 20;
// A longer time means that the machine's clock was set meanwhile.
constexpr Duration kMaxInSocket = std::chrono::seconds(1);

/// How long ago the kernel received what `message` holds.
Duration since_arrival(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec at{};
    std::memcpy(&at, CMSG_DATA(part), sizeof at);
    const Duration age = std::chrono::system_clock::now().time_since_epoch() -
                         (std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec));
    return age < Duration::zero() || age > kMaxInSocket ? Duration::zero() : age;
  }
  return Duration::zero();
}

struct Datagram {
  ssize_t size = -1;  ///< as sent, even if longer than the buffer; negative: none waits
  Duration age{};     ///< since it reached the machine
};

Datagram read_datagram(int socket, std::span<std::uint8_t> into) {
  iovec place{.iov_base = into.data(), .iov_len = into.size()};
  alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(timespec))> control{};
  msghdr message{};
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  Datagram datagram{.size = ::recvmsg(socket, &message, MSG_TRUNC)};
  if (datagram.size >= 0) datagram.age = since_arrival(message);
  return datagram;
}

}  // namespace

Result<std::unique_ptr<UdpLink>> UdpLink::open(const std::string& host, std::uint16_t port,
                                               LinkClock& clock) {
  const Result<Peer> peer = find(host, port);
  if (!peer) return peer.error();
  const int socket = ::socket(peer->address.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0)
    return Error{ErrorCode::kInvalidInput,
                 "udp://" + host + ": the system gives no socket: " + std::strerror(errno)};
  const int on = 1;
  static_cast<void>(::setsockopt(socket, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on));
  static_cast<void>(
      ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &kSocketBufferBytes, sizeof kSocketBufferBytes));
  return std::unique_ptr<UdpLink>(new UdpLink(socket, *peer, clock));
}

Result<UdpLink::Peer> UdpLink::find(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* list = nullptr;
  const int failure = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (failure != 0)
    return Error{ErrorCode::kNotFound, "udp://" + host + ": no such host (" + ::gai_strerror(failure) +
                                           "); check the name, or write its address"};
  Peer peer;
  for (const addrinfo* one = list; one != nullptr; one = one->ai_next) {
    if (peer.size > 0 && one->ai_family != AF_INET) continue;
    peer.size = one->ai_addrlen;
    std::memcpy(&peer.address, one->ai_addr, peer.size);
    if (one->ai_family == AF_INET) break;
  }
  ::freeaddrinfo(list);
  return peer;
}

UdpLink::~UdpLink() {
  if (associated_) static_cast<void>(::send(socket_, kFarewell.data(), kFarewell.size(), MSG_NOSIGNAL));
  ::close(socket_);
}

Status UdpLink::send(std::span<const std::uint8_t> packet) { return uplink_.push(packet); }

Result<LinkFrame> UdpLink::receive(Duration timeout) {
  HostTime now = clock_.now();
  const HostTime deadline = now + timeout;
  for (;;) {
    note_silence(now);
    keep_alive(now);
    // A client that sends without end must not keep what arrives waiting.
    const bool listens_first = std::exchange(has_just_sent_, false);
    if (!listens_first)
      if (const std::optional<LinkFrame> frame = send_next(now)) return *frame;
    if (const std::optional<LinkFrame> frame = take_datagrams()) return *frame;
    if (listens_first)
      if (const std::optional<LinkFrame> frame = send_next(now)) return *frame;
    now = clock_.now();
    // A text this short needs no memory.
    if (now >= deadline) return Error{ErrorCode::kTimeout, "no packet"};
    const HostTime alive_at =
        received_at_ ? std::min(sent_at_ + kMaxSendPause, *received_at_ + kLinkSilence) : registers_at_;
    wait_until(std::min(deadline, alive_at), now);
    now = clock_.now();
  }
}

void UdpLink::note_silence(HostTime now) {
  if (!received_at_ || now - *received_at_ < kLinkSilence) return;
  received_at_.reset();
  registers_at_ = now;
  statistics_.condition = LinkCondition::kSilent;
  ++statistics_.silences;
}

void UdpLink::note_received(HostTime now) {
  received_at_ = now;
  statistics_.condition = LinkCondition::kConnected;
}

void UdpLink::keep_alive(HostTime now) {
  if (received_at_) {
    if (now - sent_at_ >= kMaxSendPause) transmit(kNullPacket, now);
  } else if (now >= registers_at_) {
    transmit(kRegistration, now);
    transmit(kNullPacket, now);
    registers_at_ = now + kRegistrationPeriod;
  }
}

std::optional<LinkFrame> UdpLink::send_next(HostTime now) {
  static_cast<void>(uplink_.client_waits());
  while (const std::optional<UplinkQueue::Packet> packet = uplink_.next()) {
    if (!transmit(bytes_of(packet->bytes), now)) continue;
    delivered_at_ = std::max(delivered_at_, now);
    LinkFrame sent = frame_of(LinkDirection::kToVehicle, delivered_at_, bytes_of(packet->bytes));
    sent.is_ours = packet->is_ours;
    has_just_sent_ = !packet->is_ours;
    return sent;
  }
  return std::nullopt;
}

/// Reads what has arrived, up to the first datagram to deliver.
std::optional<LinkFrame> UdpLink::take_datagrams() {
  for (int i = 0; i < kMaxAtOnce; ++i) {
    LinkFrame frame;
    const auto [size, age] = read_datagram(socket_, frame.bytes);
    if (size < 0) return std::nullopt;
    frame.at = std::max(delivered_at_, clock_.ago(age));
    note_received(frame.at);
    const bool is_packet = size > 0 && static_cast<std::size_t>(size) <= kMaxCrtpPacket;
    if (is_packet) {
      frame.size = static_cast<std::uint8_t>(size);
      if (!is_null_packet(frame.packet())) {
        ++statistics_.packets_received;
        delivered_at_ = frame.at;
        return frame;
      }
    }
  }
  return std::nullopt;
}

void UdpLink::wait_until(HostTime wake_at, HostTime now) const {
  const std::array<int, 2> files{socket_, uplink_.arrivals()};
  clock_.sleep_until_readable(files, wake_at - now);
}

/// Whether the system accepted it.
bool UdpLink::transmit(std::span<const std::uint8_t> packet, HostTime now) {
  sent_at_ = now;  // also when it fails: the next attempt can wait
  if (!associated_ && !associate()) return false;
  // An ICMP error for an earlier datagram (port unreachable) fails this call, not this datagram.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (::send(socket_, packet.data(), packet.size(), MSG_NOSIGNAL) >= 0) {
      ++statistics_.packets_sent;
      if (received_at_) ++statistics_.packets_acked;  // UDP has no acknowledgements
      return true;
    }
    if (errno != ECONNREFUSED) break;
  }
  // A full socket is temporary; any other error may mean that the network has changed.
  associated_ = errno == EAGAIN || errno == ENOBUFS || errno == ECONNREFUSED;
  return false;
}

bool UdpLink::associate() {
  const sockaddr unspecified{.sa_family = AF_UNSPEC, .sa_data = {}};
  static_cast<void>(
      ::connect(socket_, &unspecified, sizeof(unspecified)));  // dissolves the previous association
  // The socket interface takes addresses of every family under this type.
  const auto* address = reinterpret_cast<const sockaddr*>(&peer_.address);
  associated_ = ::connect(socket_, address, peer_.size) == 0;
  return associated_;
}

}  // namespace swiftlet
