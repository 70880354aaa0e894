// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_toc.hpp"

#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {

bool LogToc::on_reply(std::span<const std::uint8_t> packet) {
  if (const std::optional<TocInfo> info = read_toc_info(packet)) {
    on_info(*info);
    return true;
  }
  std::optional<TocItem> item = read_toc_item(packet);
  const std::optional<LogType> type = item ? log_type_of(item->type) : std::nullopt;
  if (!type) return false;
  add(item->id, *type, std::move(item->name));
  return true;
}

void LogToc::on_info(const TocInfo& received) {
  if (info_ && *info_ != received) clear();
  info_ = received;
}

void LogToc::add(std::uint16_t id, LogType type, std::string name) {
  if (items_.size() <= id) items_.resize(std::size_t{id} + 1);
  items_[id] = {type, std::move(name)};
}

void LogToc::clear() {
  info_.reset();
  items_.clear();
}

std::string_view LogToc::name_of(std::uint16_t id) const {
  return id < items_.size() ? std::string_view(items_[id].name) : std::string_view();
}

LogType LogToc::type_of(std::uint16_t id) const {
  SWIFTLET_CHECK(has(id), "only a known variable has a type");
  return items_[id].type;
}

}  // namespace swiftlet
