// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_monitor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace swiftlet {
namespace {

enum Variable : std::size_t {
  kBatteryMillivolts,
  kBatteryVolts,
  kRssi,
  kSupervisor,
  kFlies,
  kBatteryState,
  kFirstRange
};
constexpr std::array<std::string_view, 10> kNames{
    "pm.vbatMV", "pm.vbat",     "radio.rssi", "supervisor.info", "sys.isFlying",
    "pm.state",  "range.front", "range.left", "range.back",      "range.right"};

constexpr int kLowPower = 3;  // of pm.state
constexpr double kTurnedRad = 0.5;
// Twenty measurements; neither a vehicle in flight nor a sensor is that still.
constexpr Duration kFrozen = std::chrono::seconds(2);
constexpr int kOutOfReachMm = 4000;

}  // namespace

void VehicleMonitor::on_frame(const LogRecord& record) {
  const Slots& slots = slots_of(record);
  const auto value = [&](std::size_t variable, double scale = 1.0) -> std::optional<int> {
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
  Ranges ranges_mm{};
  bool has_ranges = true;
  for (std::size_t i = 0; i < ranges_mm.size(); ++i) {
    const std::optional<int> range_mm = value(kFirstRange + i);
    has_ranges = has_ranges && range_mm;
    ranges_mm[i] = range_mm.value_or(0);
  }
  if (has_ranges) watch_ranges(ranges_mm, record.at);
}

void VehicleMonitor::watch_ranges(const Ranges& ranges_mm, DeviceTime at) {
  const auto is_hit = [](int range_mm) { return range_mm > 0 && range_mm < kOutOfReachMm; };
  const bool could_move = health_.is_flying.value_or(true) && std::ranges::any_of(ranges_mm, is_hit);
  if (!could_move || ranges_mm != ranges_mm_ || !ranges_moved_at_) {
    ranges_moved_at_ = at;
    frozen_reported_ = false;
  }
  ranges_mm_ = ranges_mm;
  ranges_are_frozen_ = at - *ranges_moved_at_ >= kFrozen;
}

void VehicleMonitor::on_odometry(const Pose2& T_odom_body) {
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
  if (yaw_trap_ && !yaw_trap_reported_) {
    yaw_trap_reported_ = true;
    return VehicleEvent{VehicleEvent::Kind::kYawTrap, 0};
  }
  if (health_.battery_is_low && !battery_reported_) {
    battery_reported_ = true;
    return VehicleEvent{VehicleEvent::Kind::kBatteryLow, health_.battery_mv.value_or(0)};
  }
  if (ranges_are_frozen_ && !frozen_reported_) {
    frozen_reported_ = true;
    return VehicleEvent{VehicleEvent::Kind::kRangesFrozen, 0};
  }
  return std::nullopt;
}

void VehicleMonitor::restart() {
  health_ = {};
  T_odom_standing_.reset();
  ranges_moved_at_.reset();
  yaw_trap_ = yaw_trap_reported_ = battery_reported_ = ranges_are_frozen_ = frozen_reported_ = false;
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
