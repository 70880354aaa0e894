// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "daemon/publish/publisher.hpp"

namespace swiftlet {

/// Publishes over LCM with the types in proto/; docs/lcm.md lists the channels. Every message fits one
/// datagram. One thread at a time. Messages are encoded into a buffer of its own.
class LcmPublisher final : public Publisher {
 public:
  /// The most that one datagram carries; LCM would cut larger messages into fragments.
  static constexpr std::size_t kMaxMessageBytes = 65'499;
  static constexpr std::size_t kMaxWallsPerMessage = 1000;

  /// `map_id` names the run. kInvalidInput when LCM cannot use `url` (udpm://, file://, tcpq:// or memq://).
  [[nodiscard]] static Result<std::unique_ptr<LcmPublisher>> open(const std::string& url,
                                                                  const std::string& channel_prefix,
                                                                  std::int64_t map_id);
  ~LcmPublisher() override;

  void publish_pose(const PoseUpdate& pose) override;
  void publish_tile(HostTime now, const MapTile& tile, double resolution_m) override;
  void publish_map(HostTime now, const MapSummary& map) override;
  void publish_walls(HostTime now, std::span<const WallInMap> walls) override;
  void publish_closure(HostTime now, const ClosureUpdate& closure) override;
  void publish_status(HostTime now, const DaemonStatus& status) override;

  /// Messages that LCM did not take; the first is logged.
  [[nodiscard]] std::uint64_t failures() const;

 private:
  struct State;
  explicit LcmPublisher(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
