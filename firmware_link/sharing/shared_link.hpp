// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/client_uplink.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/sharing_status.hpp"
#include "firmware_link/session/vehicle_event.hpp"
#include "firmware_link/sharing/client_socket.hpp"
#include "firmware_link/sharing/client_traffic.hpp"

namespace swiftlet {

/// A live link that its owner shares with a client on a UDP socket, as ClientTraffic has it. Delivers what
/// passes for the client, too, marked as not the owner's, so that a recording holds it. The client is served
/// within receive(). One thread at a time; allocates only where the link does.
class SharedLink final : public Link, private ClientUplink {
 public:
  /// The clock must outlive it. Precondition: a live link.
  SharedLink(std::unique_ptr<Link> link, std::unique_ptr<ClientSocket> socket, LinkClock& clock);

  /// As the link's.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override { return link_->send(packet); }
  [[nodiscard]] LinkStatistics statistics() const override { return link_->statistics(); }

  [[nodiscard]] SharingStatus sharing() const;
  /// No client is served any more.
  void end_sharing() { socket_->close(); }
  /// Where clients connect.
  [[nodiscard]] std::uint16_t port() const { return socket_->port(); }
  /// Clients that come, go or are refused.
  [[nodiscard]] std::optional<VehicleEvent> take_event() { return socket_->take_event(); }

 private:
  [[nodiscard]] bool has_packet() override;
  [[nodiscard]] std::optional<CrtpPacket> next_packet(bool owner_waits) override;
  void take_back(const CrtpPacket& packet) override;
  [[nodiscard]] int arrivals() const override { return socket_->file(); }
  [[nodiscard]] bool is_connected() const {
    return link_->statistics().condition == LinkCondition::kConnected;
  }
  void read_socket(HostTime now);
  void send_answers();
  void deliver(const CrtpPacket& packet);

  std::unique_ptr<Link> link_;
  std::unique_ptr<ClientSocket> socket_;
  LinkClock& clock_;
  ClientTraffic traffic_;
};

}  // namespace swiftlet
