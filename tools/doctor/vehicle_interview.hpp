// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/link_statistics.hpp"
#include "firmware_link/session/live_status.hpp"
#include "firmware_link/session/log_handshake.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "firmware_link/session/vehicle_inventory.hpp"
#include "firmware_link/session/vehicle_monitor.hpp"

namespace swiftlet {

/// What a vehicle reported of itself.
struct VehicleFacts {
  bool answered = false;    ///< anything was received from it
  int protocol = 0;         ///< CRTP protocol version; 0: not reported
  std::string firmware;     ///< "2026.08"; empty: not reported
  std::string device_type;  ///< "Crazyflie 2.1"
  std::optional<bool> has_multiranger;
  std::optional<bool> has_flow_deck;
  std::optional<Error> refusal;  ///< why its log cannot be used
  bool logs = false;             ///< log data came
  VehicleHealth health;
  LinkCondition link = LinkCondition::kNone;  ///< at the end
};

/// Asks a vehicle all that the doctor wants to know, by the handshake that the daemon uses: what works here
/// works there. No link, no clock. One thread at a time; allocates; `cache` must outlive it.
class VehicleInterview {
 public:
  explicit VehicleInterview(TocCache& cache)
      : handshake_(session_, cache), inventory_(cache), monitor_(session_) {}

  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A frame of either direction.
  void on_frame(const LinkFrame& frame);

  /// All is known; or the vehicle logs, but does not answer the rest.
  [[nodiscard]] bool finished(HostTime now) const;
  /// Anything was received from the vehicle.
  [[nodiscard]] bool answered() const { return answered_; }
  [[nodiscard]] VehicleFacts facts() const;

 private:
  LogSession session_;
  LogHandshake handshake_;
  VehicleInventory inventory_;
  VehicleMonitor monitor_;
  bool answered_ = false;
  bool logs_ = false;
  std::optional<HostTime> log_ended_at_;  ///< the handshake, one way or the other
};

/// How long the doctor waits.
struct InterviewPatience {
  Duration first_answer = std::chrono::seconds(3);
  Duration all = std::chrono::seconds(20);  ///< from the beginning
};

/// Runs an interview over a link and resets the vehicle's log at the end.
[[nodiscard]] VehicleFacts interview_vehicle(Link& link, LinkClock& clock, TocCache& cache,
                                             const InterviewPatience& patience = {});

}  // namespace swiftlet
