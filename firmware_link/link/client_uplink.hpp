// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Packets of another program that shares a live link. Called on the thread of the link: must not wait,
/// allocate or throw.
class ClientUplink {
 public:
  ClientUplink() = default;
  virtual ~ClientUplink() = default;
  ClientUplink(const ClientUplink&) = delete;
  ClientUplink& operator=(const ClientUplink&) = delete;

  /// Reads what has arrived. Whether there is a packet to send.
  [[nodiscard]] virtual bool has_packet() = 0;
  /// The packet to send next; nullopt: there is none, or it is the turn of the link's owner, which has a
  /// request to send if `owner_waits`.
  [[nodiscard]] virtual std::optional<CrtpPacket> next_packet(bool owner_waits) = 0;
  /// A packet that the link has not got acknowledged: the vehicle may have received it.
  virtual void take_back(const CrtpPacket& packet) = 0;
  /// A file descriptor that is readable when something has arrived.
  [[nodiscard]] virtual int arrivals() const = 0;
};

}  // namespace swiftlet
