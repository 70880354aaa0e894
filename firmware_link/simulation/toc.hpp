// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/simulation/packet.hpp"

namespace swiftlet {

// The firmware's answers about its tables of contents, version 2, on channel 0 of a port. It builds these
// headers itself, so their link bits are 0; other answers keep those of the request.

/// Whether a packet of channel 0 requests the length of the table.
inline bool asks_for_toc_info(std::span<const std::uint8_t> packet) {
  return packet.size() >= 2 && packet[1] == static_cast<std::uint8_t>(TocCommand::kInfo);
}
/// The item that a packet of channel 0 requests; nullopt if it requests none.
inline std::optional<std::uint16_t> wanted_toc_item(std::span<const std::uint8_t> packet) {
  const bool asks = packet.size() >= 4 && packet[1] == static_cast<std::uint8_t>(TocCommand::kItem);
  return asks ? std::optional(load_u16(packet, 2)) : std::nullopt;
}

inline PacketBytes simulated_toc_reply(CrtpTopic topic, TocCommand command) {
  PacketBytes reply;
  put(reply, static_cast<std::uint8_t>(topic.port << 4U | topic.channel));
  put(reply, static_cast<std::uint8_t>(command));
  return reply;
}
/// Each port appends its own fields.
inline PacketBytes simulated_toc_info(CrtpTopic topic, std::size_t count, std::uint32_t crc) {
  PacketBytes reply = simulated_toc_reply(topic, TocCommand::kInfo);
  put_little_endian(reply, count, 2);
  put_little_endian(reply, crc, 4);
  return reply;
}
/// Precondition: the name fits the packet.
inline PacketBytes simulated_toc_item(CrtpTopic topic, std::uint16_t id, std::uint8_t type,
                                      std::string_view group, std::string_view name) {
  PacketBytes reply = simulated_toc_reply(topic, TocCommand::kItem);
  put_little_endian(reply, id, 2);
  put(reply, type);
  put_text(reply, group);
  put_text(reply, name);
  return reply;
}
/// The answer that the table has no such item.
inline PacketBytes simulated_toc_end(CrtpTopic topic) {
  return simulated_toc_reply(topic, TocCommand::kItem);
}

}  // namespace swiftlet
