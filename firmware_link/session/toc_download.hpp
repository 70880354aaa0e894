// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/pending_request.hpp"
#include "firmware_link/session/repeat_timer.hpp"
#include "firmware_link/session/toc_cache.hpp"

namespace swiftlet {

/// Downloads one port's table of contents, or takes it from the cache; a downloaded table is stored there.
/// Several items are requested at a time, each again when its answer takes longer than answers do: one by
/// one, a slow or lossy link would take minutes. No clock, no link: the caller passes the time and the
/// packets received. One thread at a time; allocates.
class TocDownload {
 public:
  /// Items requested and not received, at most. The firmware's queues hold as many requests for a port.
  static constexpr std::size_t kMaxOpen = 16;

  /// `topic`: kLogTocTopic or kParamTocTopic. `timer`: what is known of the round trip. `cache` must outlive
  /// it.
  TocDownload(const CrtpTopic& topic, TocCache& cache, const RepeatTimer& timer = {});

  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A packet from the vehicle.
  void on_frame(std::span<const std::uint8_t> packet, HostTime at);

  [[nodiscard]] bool finished() const { return finished_; }
  /// Final.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  [[nodiscard]] bool came_from_cache() const { return from_cache_; }
  /// The share of the items that is known, 0 to 1.
  [[nodiscard]] double progress() const;
  /// What it has learnt of the round trip.
  [[nodiscard]] const RepeatTimer& timer() const { return timer_; }
  /// Once finished.
  [[nodiscard]] const TocInfo& info() const { return info_; }
  /// Once finished: all items, by id.
  [[nodiscard]] const std::vector<TocItem>& items() const { return items_; }
  /// Once finished: the reply in which the vehicle names an item; nullopt when it fits no packet.
  [[nodiscard]] std::optional<CrtpPacket> reply_of(const TocItem& item) const {
    return toc_item_reply(topic_, item);
  }
  /// nullptr: the vehicle has none of that name.
  [[nodiscard]] const TocItem* find(std::string_view name) const;

 private:
  struct OpenItem {
    std::uint16_t id = 0;
    HostTime sent_at{};
    bool was_repeated = false;
  };
  void on_info(const TocInfo& info);
  void on_item(TocItem item, HostTime at);
  void finish();
  [[nodiscard]] CrtpPacket repeat(OpenItem& item, HostTime now);

  CrtpTopic topic_;
  TocCache* cache_;
  PendingRequest request_;  // of length and crc
  RepeatTimer timer_;       // of items
  HostTime waits_longer_since_{};
  bool knows_info_ = false;
  TocInfo info_;
  std::vector<TocItem> items_;  // by id, nameless while unknown
  std::size_t known_ = 0;
  std::uint16_t next_id_ = 0;  // of those not requested yet
  FixedVector<OpenItem, kMaxOpen> open_;
  int refused_in_a_row_ = 0;  // since the last item
  bool finished_ = false;
  bool from_cache_ = false;
  std::optional<Error> failure_;
};

}  // namespace swiftlet
