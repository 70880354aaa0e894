// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/shared_link.hpp"

#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/link/uplink_queue.hpp"

namespace swiftlet {
namespace {

// Datagrams read at once: a flood must not keep the link waiting.
constexpr int kMaxAtOnce = 64;

}  // namespace

SharedLink::SharedLink(std::unique_ptr<Link> link, std::unique_ptr<ClientSocket> socket, LinkClock& clock)
    : link_(std::move(link)), socket_(std::move(socket)), clock_(clock) {
  UplinkQueue* const uplink = link_->uplink();
  SWIFTLET_CHECK(uplink != nullptr, "a live link is shared");
  uplink->share_with(*this);
}

Result<LinkFrame> SharedLink::receive(Duration timeout) {
  Result<LinkFrame> frame = link_->receive(timeout);
  if (!frame) return frame;
  if (const std::optional<CrtpPacket> packet = traffic_.on_frame(*frame)) deliver(*packet);
  send_answers();
  if (traffic_.take_loss_of_blocks()) socket_->report_lost_blocks();
  return frame;
}

SharingStatus SharedLink::sharing() const {
  return {.is_shared = true, .has_client = socket_->has_client(), .counters = traffic_.counters()};
}

bool SharedLink::has_packet() {
  const HostTime now = clock_.now();
  read_socket(now);
  if (socket_->has_fallen_silent(now)) traffic_.abandon();
  if (!is_connected()) {
    traffic_.drop_steering();
    return false;
  }
  return traffic_.has_packet(now);
}

void SharedLink::read_socket(HostTime now) {
  for (int i = 0; i < kMaxAtOnce; ++i) {
    const ClientSocket::Arrival arrival = socket_->receive(now, is_connected());
    if (!arrival.is_any) return;
    if (arrival.ended) traffic_.abandon();
    traffic_.take(arrival.packet, now);
  }
}

std::optional<CrtpPacket> SharedLink::next_packet(bool owner_waits) {
  if (!is_connected()) return std::nullopt;
  const std::optional<CrtpPacket> packet = traffic_.next_packet(owner_waits, clock_.now());
  send_answers();
  return packet;
}

void SharedLink::take_back(const CrtpPacket& packet) {
  if (socket_->has_client()) traffic_.take_back(packet);
}

void SharedLink::send_answers() {
  while (const std::optional<CrtpPacket> answer = traffic_.take_answer()) deliver(*answer);
}

void SharedLink::deliver(const CrtpPacket& packet) {
  if (socket_->has_client()) socket_->send(bytes_of(packet));
}

}  // namespace swiftlet
