// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

// Tables of contents, version 2: channel 0 of the log and of the param port.

/// The length of a table, and an opaque key of its contents.
struct TocInfo {
  std::uint16_t count = 0;
  std::uint32_t crc = 0;
  bool operator==(const TocInfo&) const = default;
};

/// One entry. Its `id` is a position in the firmware image and differs between builds.
struct TocItem {
  std::uint16_t id = 0;
  std::uint8_t type = 0;  ///< as on the wire; its meaning is the port's
  std::string name;       ///< "group.name"
  bool operator==(const TocItem&) const = default;
};

/// nullopt: the packet is another reply, or truncated.
[[nodiscard]] std::optional<TocInfo> read_toc_info(std::span<const std::uint8_t> packet);
[[nodiscard]] std::optional<TocItem> read_toc_item(std::span<const std::uint8_t> packet);
/// The reply in which the vehicle names an item; nullopt when the name does not fit a packet.
[[nodiscard]] std::optional<CrtpPacket> toc_item_reply(const CrtpTopic& topic, const TocItem& item);

}  // namespace swiftlet
