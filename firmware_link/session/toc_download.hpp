// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/pending_request.hpp"
#include "firmware_link/session/toc_cache.hpp"

namespace swiftlet {

/// Downloads one port's table of contents, item by item, or takes it from the cache; a downloaded table is
/// stored there. No clock, no link: the caller passes the time and the packets received. One thread at a
/// time; allocates.
class TocDownload {
 public:
  /// `topic`: kLogTocTopic or kParamTocTopic. `cache` must outlive it.
  TocDownload(const CrtpTopic& topic, TocCache& cache);

  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now) { return request_.take_due(now); }
  /// A packet from the vehicle.
  void on_frame(std::span<const std::uint8_t> packet);

  [[nodiscard]] bool finished() const { return finished_; }
  /// Final.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  [[nodiscard]] bool came_from_cache() const { return from_cache_; }
  /// Once finished.
  [[nodiscard]] const TocInfo& info() const { return info_; }
  /// Once finished: all items, by id.
  [[nodiscard]] const std::vector<TocItem>& items() const { return items_; }
  /// nullptr: the vehicle has none of that name.
  [[nodiscard]] const TocItem* find(std::string_view name) const;

 private:
  void on_info(const TocInfo& info);
  void ask_next_item();

  CrtpTopic topic_;
  TocCache* cache_;
  PendingRequest request_;
  bool knows_info_ = false;
  TocInfo info_;
  std::vector<TocItem> items_;
  bool finished_ = false;
  bool from_cache_ = false;
  std::optional<Error> failure_;
};

}  // namespace swiftlet
