// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/vehicle_monitor.hpp"

#include <cmath>

namespace swiftlet {
namespace {

enum Variable : std::size_t { kBatteryMillivolts, kBatteryVolts, kRssi, kSupervisor, kFlies, kBatteryState };
constexpr std::array<std::string_view, 6> kNames{"pm.vbatMV",       "pm.vbat",      "radio.rssi",
                                                 "supervisor.info", "sys.isFlying", "pm.state"};

constexpr int kLowPower = 3;  // of pm.state
// More than an estimate at rest wanders.
constexpr double kCarriedM = 0.5;
constexpr double kTurnedRad = 0.5;

}  // namespace

void VehicleMonitor::hear(const LogRecord& record) {
  const Slots& slots = slots_of(record);
  const auto value = [&](Variable variable, double scale = 1.0) -> std::optional<int> {
    const std::optional<std::uint8_t> slot = slots[variable];
    if (!slot || *slot >= record.entry_count) return std::nullopt;
    return static_cast<int>(std::lround(record.value(*slot) * scale));
  };
  if (const auto millivolts = value(kBatteryVolts, 1000.0)) health_.battery_mv = millivolts;
  if (const auto millivolts = value(kBatteryMillivolts)) health_.battery_mv = millivolts;
  if (const auto rssi = value(kRssi)) health_.rssi_dbm = -*rssi;
  if (const auto flies = value(kFlies)) health_.is_flying = *flies != 0;
  if (const auto info = value(kSupervisor))
    health_.is_flying = (static_cast<unsigned>(*info) & kSupervisorFlying) != 0;
  if (const auto state = value(kBatteryState)) health_.battery_is_low = *state == kLowPower;
}

void VehicleMonitor::see(const Pose2& T_odom_body) {
  if (health_.is_flying.value_or(true)) {
    T_odom_standing_.reset();
    return;
  }
  if (!T_odom_standing_) T_odom_standing_ = T_odom_body;
  const Pose2 moved = between(*T_odom_standing_, T_odom_body);
  yaw_trap_ =
      yaw_trap_ || std::hypot(moved.x_m(), moved.y_m()) > kCarriedM || std::abs(moved.yaw_rad()) > kTurnedRad;
}

std::optional<VehicleEvent> VehicleMonitor::take_event() {
  if (yaw_trap_ && !told_yaw_trap_) {
    told_yaw_trap_ = true;
    return VehicleEvent{VehicleEvent::Kind::kYawTrap, 0};
  }
  if (health_.battery_is_low && !told_battery_) {
    told_battery_ = true;
    return VehicleEvent{VehicleEvent::Kind::kBatteryLow, health_.battery_mv.value_or(0)};
  }
  return std::nullopt;
}

void VehicleMonitor::restart() {
  health_ = {};
  T_odom_standing_.reset();
  yaw_trap_ = told_yaw_trap_ = told_battery_ = false;
}

const VehicleMonitor::Slots& VehicleMonitor::slots_of(const LogRecord& record) {
  if (revision_ != session_.revision()) {
    revision_ = session_.revision();
    slots_.fill(std::nullopt);
  }
  std::optional<Slots>& slots = slots_[record.block_id];
  if (!slots) {
    slots.emplace();
    for (std::size_t i = 0; i < record.entry_count; ++i)
      for (std::size_t v = 0; v < kNames.size(); ++v)
        if (session_.name_of(record, i) == kNames[v]) (*slots)[v] = static_cast<std::uint8_t>(i);
  }
  return *slots;
}

}  // namespace swiftlet
