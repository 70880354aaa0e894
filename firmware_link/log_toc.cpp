// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/log_toc.hpp"

#include <algorithm>
#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/byte_order.hpp"
#include "firmware_link/crtp_packet.hpp"

namespace swiftlet {

bool LogToc::hear_reply(std::span<const std::uint8_t> packet) {
  if (packet.size() >= 8 && packet[1] == static_cast<std::uint8_t>(LogTocCommand::kInfo)) {
    hear_info(packet);
    return true;
  }
  return packet.size() >= 5 && packet[1] == static_cast<std::uint8_t>(LogTocCommand::kItem) &&
         hear_item(packet);
}

void LogToc::hear_info(std::span<const std::uint8_t> packet) {
  const Info heard{load_u16(packet, 2), load_u32(packet, 4)};
  if (info_ && (info_->crc != heard.crc || info_->count != heard.count)) clear();
  info_ = heard;
}

bool LogToc::hear_item(std::span<const std::uint8_t> packet) {
  const std::optional<LogType> type = log_type_of(packet[4]);
  const auto group_end = std::find(packet.begin() + 5, packet.end(), std::uint8_t{0});
  if (!type || group_end == packet.end()) return false;
  const auto name_end = std::find(group_end + 1, packet.end(), std::uint8_t{0});
  std::string name(packet.begin() + 5, group_end);
  name += '.';
  name.append(group_end + 1, name_end);
  add(load_u16(packet, 2), *type, std::move(name));
  return true;
}

void LogToc::add(std::uint16_t id, LogType type, std::string name) {
  if (items_.size() <= id) items_.resize(std::size_t{id} + 1);
  if (items_[id].name.empty()) ++known_;
  items_[id] = {type, std::move(name)};
}

void LogToc::clear() {
  info_.reset();
  items_.clear();
  known_ = 0;
}

std::string_view LogToc::name_of(std::uint16_t id) const {
  return id < items_.size() ? std::string_view(items_[id].name) : std::string_view();
}

LogType LogToc::type_of(std::uint16_t id) const {
  SWIFTLET_CHECK(has(id), "only a known variable has a type");
  return items_[id].type;
}

std::optional<std::uint16_t> LogToc::find(std::string_view name) const {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [name](const Item& item) { return item.name == name; });
  if (found == items_.end()) return std::nullopt;
  return static_cast<std::uint16_t>(found - items_.begin());
}

}  // namespace swiftlet
