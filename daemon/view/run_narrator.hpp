// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/view/run_history.hpp"

namespace swiftlet {

/// Puts what changes in a run into words: the log that the page shows. One thread at a time.
class RunNarrator {
 public:
  /// Events are added to `history`, which must outlive the narrator.
  explicit RunNarrator(RunHistory& history) : history_(history) {}

  /// Each is called before the history is given the same. A new generation of the history begins anew.
  void see_pose(const TrailPose& pose);
  void see_status(const RunStatus& status);
  void see_event(const std::string& text, std::int64_t utime_us);
  void see_closure(const SeenClosure& closure, bool is_dropped, std::int64_t utime_us);

 private:
  RunHistory& history_;
  std::uint32_t generation_ = 0;
  std::optional<RunStatus> status_;
  std::optional<TrailPose> pose_;
  bool battery_is_low_ = false;
  /// What has been told of something that is counted.
  struct Losses {
    std::int64_t count = 0;
    std::optional<std::int64_t> at_us{};  // unset: nothing yet
  };
  Losses missing_;
  Losses late_;

  void begin_with_run();
  void tell_tracking(const TrailPose& pose);
  void tell_state(const RunStatus& status);
  void tell_link(const RunStatus& status);
  void tell_battery(const RunStatus& status);
  void tell_losses(const RunStatus& status);
  void tell_more(Losses& told, std::int64_t count, std::int64_t utime_us, std::string_view thing,
                 std::string_view fate);
};

}  // namespace swiftlet
