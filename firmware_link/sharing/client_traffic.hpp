// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/sharing_status.hpp"
#include "firmware_link/sharing/client_log_blocks.hpp"
#include "firmware_link/sharing/open_requests.hpp"
#include "firmware_link/sharing/packet_ring.hpp"

namespace swiftlet {

/// Whether a packet steers: setpoints (port 3), generic setpoints (7) and high-level commands (8).
[[nodiscard]] bool is_steering(std::span<const std::uint8_t> packet);

/// The packets of a client that shares the link with its owner. What steers comes first, in its order; all
/// else takes turns with the owner's requests, and waits until the owner has reset the vehicle's log. Each
/// side gets the answers to its own requests; what the vehicle sends to all goes to both. No link, no socket,
/// no clock. Fixed storage, allocates nothing; one thread at a time.
class ClientTraffic {
 public:
  static constexpr std::size_t kSteeringCapacity = 256;
  static constexpr std::size_t kRequestCapacity = 64;
  /// So many packets that steer, one behind the other, let one other packet through: a client that sends more
  /// than the link carries must not end the map.
  static constexpr int kMaxSteeringInARow = 64;
  /// A setpoint that has waited so long is dropped where a newer one of its kind waits: after a silence the
  /// vehicle must not fly along what is over. Clients repeat setpoints at ten a second and more.
  static constexpr Duration kSetpointLife = std::chrono::milliseconds(100);

  /// A packet of the client, in the order in which they came. Null packets are the link's own and are
  /// dropped, and so is what finds no room.
  void take(std::span<const std::uint8_t> packet, HostTime now);
  /// Whether next_packet() would have one if the owner had none.
  [[nodiscard]] bool has_packet(HostTime now) const;
  /// As ClientUplink's.
  [[nodiscard]] std::optional<CrtpPacket> next_packet(bool owner_waits, HostTime now);
  /// The vehicle is not received: what steers would come too late.
  void drop_steering();
  /// As ClientUplink's. A request is sent again, before those that wait; the vehicle may execute it twice,
  /// which does no harm to a parameter, a stop or a log block.
  void take_back(const CrtpPacket& packet);

  /// The client's share of a frame that the link has delivered, if any; marks the frame where it is not the
  /// owner's.
  [[nodiscard]] std::optional<CrtpPacket> on_frame(LinkFrame& frame);
  /// Answers that the vehicle is not asked for. Call until empty after next_packet() and on_frame().
  [[nodiscard]] std::optional<CrtpPacket> take_answer();
  /// Whether the client has lost log blocks since the last call, because the owner reset the vehicle's log.
  [[nodiscard]] bool take_loss_of_blocks() { return std::exchange(has_lost_blocks_, false); }

  /// The client is gone: nothing of it is sent any more but what steers, which may be its last word to the
  /// motors; its log blocks are deleted.
  void abandon();

  [[nodiscard]] const SharingCounters& counters() const { return counters_; }

 private:
  struct Steering {
    CrtpPacket packet;
    HostTime came_at{};
  };
  [[nodiscard]] std::optional<CrtpPacket> next_steering(HostTime now);
  [[nodiscard]] bool is_overtaken(HostTime now) const;
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  [[nodiscard]] std::optional<CrtpPacket> translate(const CrtpPacket& packet);
  void on_sent_by_owner(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::optional<CrtpPacket> on_log_control(LinkFrame& frame);
  [[nodiscard]] std::optional<CrtpPacket> on_log_data(LinkFrame& frame);
  [[nodiscard]] std::optional<CrtpPacket> on_answer(LinkFrame& frame);

  PacketRing<kSteeringCapacity, Steering> steering_;
  PacketRing<kRequestCapacity> requests_;
  PacketRing<kRequestCapacity> answers_;
  std::optional<CrtpPacket> taken_back_;  ///< as it was sent
  int steering_in_a_row_ = 0;
  bool was_clients_ = false;  ///< the last packet that did not steer
  bool log_was_reset_ = false;
  bool has_lost_blocks_ = false;
  ClientLogBlocks blocks_;
  OpenRequests open_;
  OpenRequests owners_open_;
  SharingCounters counters_;
};

}  // namespace swiftlet
