// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>

#include "daemon/view/conversation.hpp"
#include "daemon/view/page_messages.hpp"
#include "daemon/view/run_history.hpp"

namespace swiftlet {

/// A RunHistory for the thread that fills it and the one that shows it.
struct SharedRunHistory {
  std::mutex mutex;  ///< to be held while `history` is used
  RunHistory history;
};

/// One page that looks at a run: knows what it has been sent and what moment it looks at. Its memory is
/// bounded by the run's, not by how fast the page reads.
class Viewer final : public Conversation {
 public:
  static constexpr std::size_t kTilesPerMessage = 64;
  static constexpr std::size_t kPosesPerMessage = 4096;

  /// Both must outlive the viewer; `source` does not change.
  Viewer(SharedRunHistory& shared, const ShownSource& source) : shared_(shared), source_(source) {}

  [[nodiscard]] std::optional<WebMessage> next() override;
  void take(std::string_view text) override;

 private:
  SharedRunHistory& shared_;
  const ShownSource& source_;
  std::optional<std::int64_t> at_us_;  // what is looked at; unset: the newest
  bool is_synced_ = false;
  std::uint64_t synced_changes_ = 0;

  // What has been sent of the run.
  struct Sent {
    std::uint32_t generation = 0;
    std::uint32_t pose_serial = 0;
    std::uint32_t event_serial = 0;
    std::uint64_t closure_change = 0;
    std::uint32_t status_serial = 0;
    StoreyId storey{};
    std::uint32_t walls_serial = 0;
    std::map<TileIndex, std::uint32_t> tile_versions{};
  };
  Sent sent_;

  [[nodiscard]] std::optional<WebMessage> next_of_run(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_status(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_poses(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_events(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_closures(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_storey(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_walls(const RunHistory& history);
  [[nodiscard]] std::optional<WebMessage> next_tiles(const RunHistory& history);
  template <typename Value>
  [[nodiscard]] const typename AsOfList<Value>::Entry* looked_at(const AsOfList<Value>& list) const {
    return at_us_ ? list.at(*at_us_) : list.newest();
  }
};

}  // namespace swiftlet
