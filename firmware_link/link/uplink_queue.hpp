// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/client_uplink.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/request_queue.hpp"

namespace swiftlet {

/// What a live link has to send: the requests of its owner, and the packets of a client that shares it.
class UplinkQueue {
 public:
  struct Packet {
    CrtpPacket bytes;
    bool is_ours = true;  ///< the owner's
  };

  /// As RequestQueue::push().
  Status push(std::span<const std::uint8_t> packet) { return requests_.push(packet); }
  /// From now on sends another program's packets, too. `client` must outlive the link's next receive().
  void share_with(ClientUplink& client) { client_ = &client; }
  [[nodiscard]] bool is_shared() const { return client_ != nullptr; }

  /// Reads what the client has sent. Whether it has a packet to send.
  [[nodiscard]] bool client_waits() { return client_ != nullptr && client_->has_packet(); }
  [[nodiscard]] bool request_waits() const { return !requests_.empty(); }
  [[nodiscard]] std::optional<Packet> next() {
    if (client_ != nullptr)
      if (const std::optional<CrtpPacket> packet = client_->next_packet(!requests_.empty()))
        return Packet{*packet, false};
    if (requests_.empty()) return std::nullopt;
    return Packet{requests_.pop(), true};
  }
  void clear_requests() { requests_.clear(); }
  /// As ClientUplink's. Precondition: the client's.
  void take_back(const CrtpPacket& packet) { client_->take_back(packet); }

  /// Sleeps for that long, or until something of the client's arrives.
  void sleep_for(Duration duration, LinkClock& clock) const {
    if (client_ == nullptr) return clock.sleep_for(duration);
    const int arrivals = client_->arrivals();
    clock.sleep_until_readable({&arrivals, 1}, duration);
  }
  /// For poll(); -1, which it ignores: not shared.
  [[nodiscard]] int arrivals() const { return client_ == nullptr ? -1 : client_->arrivals(); }

 private:
  RequestQueue requests_;
  ClientUplink* client_ = nullptr;
};

}  // namespace swiftlet
