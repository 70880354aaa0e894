// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"

namespace swiftlet {

/// All walls of a moment, put together from the messages that carried them.
struct WallsMessage {
  std::int64_t utime = 0;
  std::int64_t map_id = 0;
  std::vector<landmark_t> walls;
};

using DaemonMessage =
    std::variant<pose_t, ranges_t, map_tile_t, WallsMessage, loop_closure_t, vehicle_event_t, status_t>;

/// Receives what a running swiftletd publishes (docs/lcm.md). What cannot be decoded is left out. One thread
/// at a time.
class MessageListener {
 public:
  /// `channels` without their prefix: POSE, POSE_LOCAL, POSE_ODOM, RANGES, MAP_TILE, LANDMARKS, LOOP_CLOSURE,
  /// VEHICLE_EVENT, STATUS.
  /// Errors: as LcmTransport::open(); kInvalidInput: another channel.
  [[nodiscard]] static Result<std::unique_ptr<MessageListener>> open(const std::string& url,
                                                                     const std::string& channel_prefix,
                                                                     std::span<const std::string> channels);
  MessageListener(const MessageListener&) = delete;
  MessageListener& operator=(const MessageListener&) = delete;

  /// The next message; nullopt when none came within `timeout`.
  [[nodiscard]] std::optional<DaemonMessage> receive(Duration timeout);
  /// Nothing more will come: a log was read to its end.
  [[nodiscard]] bool has_ended() const { return received_.empty() && transport_->has_ended(); }

 private:
  explicit MessageListener(std::unique_ptr<LcmTransport> transport) : transport_(std::move(transport)) {}
  template <typename Message>
  void take(std::span<const std::uint8_t> bytes);
  void take_walls(std::span<const std::uint8_t> bytes);
  [[nodiscard]] static LcmTransport::Listener taker(MessageListener* self, std::string_view channel);

  std::unique_ptr<LcmTransport> transport_;
  std::deque<DaemonMessage> received_;
  WallsMessage walls_;  // of the parts so far
};

}  // namespace swiftlet
