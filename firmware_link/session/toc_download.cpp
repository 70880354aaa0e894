// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/toc_download.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace swiftlet {

TocDownload::TocDownload(const CrtpTopic& topic, TocCache& cache) : topic_(topic), cache_(&cache) {
  request_.ask(toc_info_request(topic));
}

void TocDownload::on_frame(std::span<const std::uint8_t> packet) {
  if (finished_ || failure_ || !is_on(packet, topic_)) return;
  if (!knows_info_) {
    if (const std::optional<TocInfo> info = read_toc_info(packet)) on_info(*info);
    return;
  }
  // A reply of two bytes means that there is no such item, although the table counts it.
  if (packet.size() == 2 && packet[1] == static_cast<std::uint8_t>(TocCommand::kItem)) {
    failure_ = Error{ErrorCode::kInvalidInput, "the vehicle's table of contents ends at item " +
                                                   std::to_string(items_.size()) + " of " +
                                                   std::to_string(info_.count) + ": restart the vehicle"};
    request_.drop();
    return;
  }
  // A reply to an earlier, repeated request has another id: the timer runs on.
  std::optional<TocItem> item = read_toc_item(packet);
  if (!item || item->id != items_.size()) return;
  items_.push_back(std::move(*item));
  ask_next_item();
}

void TocDownload::on_info(const TocInfo& info) {
  knows_info_ = true;
  info_ = info;
  if (std::optional<std::vector<TocItem>> known = cache_->load(topic_.port, info)) {
    items_ = std::move(*known);
    from_cache_ = true;
    finished_ = true;
    request_.drop();
    return;
  }
  ask_next_item();
}

void TocDownload::ask_next_item() {
  if (items_.size() < info_.count) {
    request_.ask(toc_item_request(topic_, static_cast<std::uint16_t>(items_.size())));
    return;
  }
  finished_ = true;
  request_.drop();
  cache_->store(topic_.port, info_, items_);
}

const TocItem* TocDownload::find(std::string_view name) const {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [name](const TocItem& item) { return item.name == name; });
  return found == items_.end() ? nullptr : &*found;
}

}  // namespace swiftlet
