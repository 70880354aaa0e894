// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/toc_download.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace swiftlet {
namespace {

constexpr int kMaxRefusedInARow = 3;

}  // namespace

TocDownload::TocDownload(const CrtpTopic& topic, TocCache& cache, const RepeatTimer& timer)
    : topic_(topic), cache_(&cache), request_(timer), timer_(timer) {
  request_.ask(toc_info_request(topic));
}

std::optional<CrtpPacket> TocDownload::next_request(HostTime now) {
  if (!knows_info_) return request_.take_due(now);
  if (finished_ || failure_) return std::nullopt;
  for (OpenItem& item : open_)
    if (now - item.sent_at >= timer_.wait()) return repeat(item, now);
  if (next_id_ == info_.count || !open_.try_push_back({next_id_, now})) return std::nullopt;
  return toc_item_request(topic_, next_id_++);
}

CrtpPacket TocDownload::repeat(OpenItem& item, HostTime now) {
  // Once for all that were sent before: one silence is one sign of a longer round trip.
  if (item.sent_at >= waits_longer_since_) {
    timer_.on_repetition();
    waits_longer_since_ = now;
  }
  item.sent_at = now;
  item.was_repeated = true;
  return toc_item_request(topic_, item.id);
}

void TocDownload::on_frame(std::span<const std::uint8_t> packet, HostTime at) {
  if (finished_ || failure_ || !is_on(packet, topic_)) return;
  if (!knows_info_) {
    const std::optional<TocInfo> info = read_toc_info(packet);
    if (!info) return;
    request_.on_frame(packet, at);
    timer_ = request_.timer();
    return on_info(*info);
  }
  // A reply of two bytes means that there is no such item, although the table counts it; or that the request
  // was damaged on its way.
  if (packet.size() == 2 && packet[1] == static_cast<std::uint8_t>(TocCommand::kItem)) {
    if (++refused_in_a_row_ <= kMaxRefusedInARow) return;
    failure_ = Error{ErrorCode::kInvalidInput, "the vehicle's table of contents ends at item " +
                                                   std::to_string(known_) + " of " +
                                                   std::to_string(info_.count) + ": restart the vehicle"};
    return;
  }
  if (std::optional<TocItem> item = read_toc_item(packet)) on_item(std::move(*item), at);
}

void TocDownload::on_info(const TocInfo& info) {
  knows_info_ = true;
  info_ = info;
  if (std::optional<std::vector<TocItem>> known = cache_->load(topic_.port, info)) {
    items_ = std::move(*known);
    known_ = items_.size();
    from_cache_ = true;
    finished_ = true;
    return;
  }
  items_.resize(info.count);
  if (info.count == 0) finish();
}

void TocDownload::on_item(TocItem item, HostTime at) {
  const auto asked =
      std::find_if(open_.begin(), open_.end(), [&item](const OpenItem& open) { return open.id == item.id; });
  if (asked == open_.end()) return;  // the reply to a repetition
  if (!asked->was_repeated) timer_.on_round_trip(at - asked->sent_at);
  open_.erase(static_cast<std::size_t>(asked - open_.begin()));
  refused_in_a_row_ = 0;
  items_[item.id] = std::move(item);
  ++known_;
  if (known_ == items_.size()) finish();
}

void TocDownload::finish() {
  finished_ = true;
  cache_->store(topic_.port, info_, items_);
}

double TocDownload::progress() const {
  if (finished_) return 1.0;
  return items_.empty() ? 0.0 : static_cast<double>(known_) / static_cast<double>(items_.size());
}

const TocItem* TocDownload::find(std::string_view name) const {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [name](const TocItem& item) { return item.name == name; });
  return found == items_.end() ? nullptr : &*found;
}

}  // namespace swiftlet
