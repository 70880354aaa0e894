// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/monotonic_time.hpp"
#include "daemon/view/conversation.hpp"
#include "daemon/view/foxglove_feed.hpp"
#include "daemon/view/viewer.hpp"

namespace swiftlet {

/// Which of the subprotocols that a client offers is Foxglove's and is spoken; empty: none.
[[nodiscard]] std::string_view foxglove_subprotocol(const std::vector<std::string_view>& offered);

/// One client of Foxglove's WebSocket protocol, version 1: is told of the channels, and of what it subscribes
/// to. A recording is played from its beginning, from the first subscription on. A client that reads slowly
/// gets the newest state. It cannot change anything.
class FoxgloveConversation final : public Conversation {
 public:
  using Now = std::function<MonotonicTime()>;

  /// `shared` and `source` must outlive it; `source` does not change.
  FoxgloveConversation(SharedRunHistory& shared, const ShownSource& source, Now now);

  [[nodiscard]] std::optional<WebMessage> next() override;
  void take(std::string_view text) override;

 private:
  SharedRunHistory& shared_;
  const ShownSource& source_;
  Now now_;
  FoxgloveFeed feed_;
  int greetings_ = 0;                                       // sent
  std::map<FoxgloveTopic, std::uint32_t> subscriptions_{};  // the client's ids of them
  std::string complaint_;                                   // about the client's last message
  std::optional<MonotonicTime> playing_since_;
  std::uint32_t played_generation_ = 0;

  [[nodiscard]] std::optional<std::int64_t> moment(const RunHistory& history);
  void subscribe(std::uint32_t id, std::uint64_t channel);
  void unsubscribe(std::uint32_t id);
};

}  // namespace swiftlet
