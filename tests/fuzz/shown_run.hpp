// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/check.hpp"
#include "daemon/view/conversation.hpp"
#include "daemon/view/viewer.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {

/// A run with something of each kind, which grows.
class ShownRun {
 public:
  SharedRunHistory shared;

  ShownRun() {
    SWIFTLET_CHECK(shared.history.enter_run(1, 0.0), "the first run is entered");
    grow();
    shared.history.add_ranges(0, {0.0F, 1.0F}, {1.5F, -1.0F});
    shared.history.add_tile(kSecondUs, uniform_tile({-1, 2}, 1, 100), 0.05);
    shared.history.add_walls(kSecondUs, {{.id = 1, .start = {0, 0}, .end = {1, 0}}});
    shared.history.add_closure({.index = 1}, false, kSecondUs);
  }
  /// By a second.
  void grow() {
    const std::int64_t utime_us = kSecondUs * (1 + poses_);
    add_whole_pose(shared.history, utime_us, poses_++);
    shared.history.add_status({.utime_us = utime_us});
    shared.history.add_event(utime_us, EventLevel::kNote, "a second later");
  }

 private:
  std::int32_t poses_ = 0;
};

/// Calls `check` with what the conversation has to say now, which must come to an end.
template <typename Check>
void drain(Conversation& conversation, Check check) {
  constexpr int kMost = 10'000;
  int messages = 0;
  while (const auto message = conversation.next()) {
    SWIFTLET_CHECK(++messages < kMost, "what is to be said has an end");
    check(*message);
  }
}

/// Calls `take` with each line.
template <typename Take>
void for_each_line(std::string_view text, Take take) {
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = text.find('\n');
    take(text.substr(0, end));
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
}

}  // namespace swiftlet
