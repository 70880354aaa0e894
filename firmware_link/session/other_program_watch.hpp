// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/time.hpp"
#include "firmware_link/session/log_handshake.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

/// Recognises that another program talks to the vehicle: by answers that this one has not asked for, by log
/// data that arrives twice, and by a log that stops again and again while the vehicle answers. One thread at
/// a time; allocates nothing.
class OtherProgramWatch {
 public:
  /// A packet from the vehicle, once all requests of a connection are answered.
  void on_frame(std::span<const std::uint8_t> packet, HostTime at);
  /// Log data.
  void on_record(const LogRecord& record);
  /// A log block was silent although the vehicle was received.
  void on_log_stopped(HostTime at) { on_sign(stops_, at); }

  /// At most one a minute.
  [[nodiscard]] std::optional<VehicleEvent> take_event();

 private:
  /// Signs within a time that together mean something: a single one may be a late packet.
  struct Signs {
    int enough = 0;
    Duration within{};
    VehicleEvent event;
    int count = 0;
    HostTime first_at{};
  };
  void on_sign(Signs& signs, HostTime at);

  Signs answers_{
      .enough = 3, .within = std::chrono::seconds(10), .event = {VehicleEvent::Kind::kOtherProgram}};
  Signs doubles_{
      .enough = 10, .within = std::chrono::seconds(10), .event = {VehicleEvent::Kind::kDoubledData}};
  Signs stops_{.enough = 3, .within = std::chrono::seconds(60), .event = {VehicleEvent::Kind::kOtherProgram}};
  std::array<std::optional<DeviceTime>, kMaxOwnLogBlocks> data_at_;  // of each block, by id - 1
  std::optional<HostTime> reported_at_;
  std::optional<VehicleEvent> event_;
};

}  // namespace swiftlet
