// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/crtp/toc_item.hpp"

#include <algorithm>
#include <string_view>

#include "firmware_link/crtp/byte_order.hpp"

namespace swiftlet {
namespace {

bool put_text(CrtpPacket& packet, std::string_view text) {
  for (const char c : text)
    if (!packet.try_push_back(static_cast<std::uint8_t>(c))) return false;
  return packet.try_push_back(0);
}

}  // namespace

std::optional<TocInfo> read_toc_info(std::span<const std::uint8_t> packet) {
  if (packet.size() < 8 || packet[1] != static_cast<std::uint8_t>(TocCommand::kInfo)) return std::nullopt;
  return TocInfo{load_u16(packet, 2), load_u32(packet, 4)};
}

std::optional<TocItem> read_toc_item(std::span<const std::uint8_t> packet) {
  if (packet.size() < 5 || packet[1] != static_cast<std::uint8_t>(TocCommand::kItem)) return std::nullopt;
  const auto group_end = std::find(packet.begin() + 5, packet.end(), std::uint8_t{0});
  if (group_end == packet.end()) return std::nullopt;
  const auto name_end = std::find(group_end + 1, packet.end(), std::uint8_t{0});
  TocItem item{load_u16(packet, 2), packet[4], std::string(packet.begin() + 5, group_end)};
  item.name += '.';
  item.name.append(group_end + 1, name_end);
  return item;
}

std::optional<CrtpPacket> toc_item_reply(const CrtpTopic& topic, const TocItem& item) {
  const std::string_view name(item.name);
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  CrtpPacket packet = make_crtp_packet(topic, {static_cast<std::uint8_t>(TocCommand::kItem),
                                               low_byte(item.id), high_byte(item.id), item.type});
  if (!put_text(packet, name.substr(0, dot)) || !put_text(packet, name.substr(dot + 1))) return std::nullopt;
  return packet;
}

}  // namespace swiftlet
