// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>

#include "firmware_link/link/client_uplink.hpp"
#include "firmware_link/link/link_packet.hpp"
#include "tests/firmware_link/frames.hpp"

namespace swiftlet {

/// A client of a link that has so many packets to send, all the same, and leaves no turn to the owner.
class ScriptedUplink final : public ClientUplink {
 public:
  ScriptedUplink(Bytes packet, int count) : left(count), packet_(std::move(packet)) {}
  bool has_packet() override { return left > 0; }
  std::optional<CrtpPacket> next_packet(bool /*owner_waits*/) override {
    if (left == 0) return std::nullopt;
    --left;
    return packet_of(packet_);
  }
  void take_back(const CrtpPacket& /*packet*/) override { ++left; }
  int arrivals() const override { return -1; }

  int left;

 private:
  Bytes packet_;
};

}  // namespace swiftlet
