// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/toc_item.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/session/log_handshake.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/other_program_watch.hpp"
#include "firmware_link/session/round_trip.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "firmware_link/session/vehicle_event.hpp"
#include "firmware_link/session/vehicle_inventory.hpp"
#include "firmware_link/session/vehicle_monitor.hpp"

namespace swiftlet {

/// Keeps a live vehicle sending: starts its log, requests its inventory, measures the round trip, and
/// restarts when a log block that samples need has sent nothing for a second: the vehicle deletes its log
/// blocks when it receives nothing for that long, or it has rebooted. No link, no clock. One thread at a
/// time; allocates while it connects, not while log data flows. `session` must outlive it and receive each
/// packet first; `cache` must outlive it.
class LiveSession {
 public:
  /// `is_shared`: a client of the same link asks the vehicle, too, and is no other program.
  LiveSession(const LogSession& session, TocCache& cache, bool is_shared = false);

  /// The packet to send now, if any.
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A packet from the vehicle; `record` if it is log data that can be read.
  void on_frame(const LinkFrame& frame, const std::optional<LogRecord>& record);
  /// The dead reckoning of each sample.
  void on_odometry(const Pose2& T_odom_body) { monitor_.on_odometry(T_odom_body); }
  /// If a table of contents came from the cache, the log's or the parameters': the replies that the vehicle
  /// would have sent, to be handled as if it had sent them now. Empty afterwards.
  [[nodiscard]] std::vector<CrtpPacket> take_cached_replies();

  /// It waits for answers that it would ask for again soon.
  [[nodiscard]] bool asks() const { return !handshake_.finished() || !inventory_.finished(); }
  /// Why the first vehicle cannot be used. Later ones are retried.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  /// The events since the last call, in order. When there are too many, the newest are dropped.
  [[nodiscard]] std::optional<VehicleEvent> take_event();
  [[nodiscard]] const VehicleHealth& health() const { return monitor_.health(); }
  [[nodiscard]] Duration round_trip() const { return round_trip_.last(); }

 private:
  /// A log block that samples need.
  struct Stream {
    std::uint8_t block = 0;
    HostTime data_at{};  ///< the last log data, or the end of the handshake
  };
  void restart();
  void report(VehicleEvent::Kind kind, std::int32_t value = 0);
  void on_handshake(const LinkFrame& frame);
  void on_inventory(const LinkFrame& frame);
  void restate_cached_params();
  void watch_for_others(const LinkFrame& frame, const std::optional<LogRecord>& record);
  void watch_for_silence(HostTime now);
  void report_progress(HostTime now);

  const LogSession& session_;
  TocCache& cache_;
  LogHandshake handshake_;
  VehicleInventory inventory_;
  std::optional<HostTime> inventory_at_;  ///< when it was complete
  std::optional<TocInfo> known_params_;   ///< this table was downloaded or restated
  std::vector<CrtpPacket> cached_params_;
  RoundTrip round_trip_;
  VehicleMonitor monitor_;
  bool is_shared_;
  OtherProgramWatch other_program_;
  FixedVector<Stream, 2> streams_;
  std::optional<HostTime> received_at_;  ///< the last packet
  std::optional<HostTime> refused_at_;   ///< the handshake failed
  std::optional<HostTime> progress_at_;  ///< reported, of the table of contents; or its beginning
  bool was_connected_ = false;
  std::uint32_t boot_ = 0;
  std::optional<Error> failure_;
  FixedVector<VehicleEvent, 16> events_;
};

}  // namespace swiftlet
