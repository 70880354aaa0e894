// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "daemon/view/foxglove_channels.hpp"
#include "daemon/view/foxglove_messages.hpp"
#include "daemon/view/run_history.hpp"

namespace swiftlet {

struct FoxgloveMessage {
  FoxgloveTopic topic{};
  std::int64_t utime_us = 0;
  std::string json;
};

/// How much may be sent, by the time of the data.
struct FoxglovePace {
  std::int64_t period_us = 1'000'000;  ///< from one map to the next; walls, closures and trail likewise
  double bytes_per_s = 50e3;           ///< of each of these: what is larger comes later
  std::size_t max_waiting = std::numeric_limits<std::size_t>::max();  ///< poses; of more, the newest is sent
};

/// Tells a RunHistory as Foxglove's messages, each change once. What is drawn is told anew with each run. One
/// thread at a time.
class FoxgloveFeed {
 public:
  explicit FoxgloveFeed(const FoxglovePace& pace) : pace_(pace) {}

  /// From now on, beginning with what there is.
  void begin(FoxgloveTopic topic);
  void end(FoxgloveTopic topic) { stream(topic).is_wanted = false; }
  /// The next message of the topics begun, in turn; nullopt: nothing new, or no pose yet. What happened
  /// before the first pose has its time. `at_us`: as the run was then, not going back; unset: the newest.
  [[nodiscard]] std::optional<FoxgloveMessage> next(const RunHistory& history,
                                                    std::optional<std::int64_t> at_us);
  /// The run has ended, and the time of the data stands: what waits for its time is due.
  void hurry();

 private:
  /// What has been sent of a topic.
  struct Stream {
    bool is_wanted = false;
    bool must_clear = false;    // what was drawn of the run before
    std::uint32_t serial = 0;   // of a pose, event, status, or list of walls
    std::uint64_t content = 0;  // of the map or closures; of walls the storey
    std::int64_t due_us = 0;
  };
  using Text = std::optional<std::string>;

  FoxglovePace pace_;
  std::uint32_t generation_ = 0;
  std::array<Stream, kFoxgloveTopics> streams_{};
  std::size_t turn_ = 0;
  TrailStretch stretch_;
  std::int32_t stretch_segment_ = 0;
  bool stretch_has_news_ = false;
  std::int64_t first_us_ = 0;          // of the first pose
  std::int64_t now_us_ = 0;            // of the data
  std::optional<std::int64_t> at_us_;  // what is told

  [[nodiscard]] Stream& stream(FoxgloveTopic topic) { return streams_[static_cast<std::size_t>(topic)]; }
  void begin_run(const RunHistory& history);
  void postpone(Stream& drawn, const std::string& text) const;
  [[nodiscard]] const TrailPose* next_pose(const RunHistory& history, std::uint32_t after) const;
  [[nodiscard]] std::optional<FoxgloveMessage> next_of(FoxgloveTopic topic, const RunHistory& history);
  [[nodiscard]] Text next_drawn(FoxgloveTopic topic, const RunHistory& history);
  [[nodiscard]] std::optional<FoxgloveMessage> pose_message(FoxgloveTopic topic, const RunHistory& history);
  [[nodiscard]] std::optional<FoxgloveMessage> log_message(const RunHistory& history);
  [[nodiscard]] std::optional<FoxgloveMessage> status_message_of(const RunHistory& history);
  [[nodiscard]] Text map_text(const RunHistory& history);
  [[nodiscard]] Text walls_text(const RunHistory& history);
  [[nodiscard]] Text closures_text(const RunHistory& history);
  [[nodiscard]] Text trail_text(const RunHistory& history);
  bool extend_stretch(const TrailPose& pose);
};

}  // namespace swiftlet
