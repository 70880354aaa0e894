// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware_link/crtp/log_value.hpp"

namespace swiftlet {

/// Bytes on the wire; 0 for an undefined type.
[[nodiscard]] std::size_t log_type_size(LogType type);

/// All values that the vehicle's log variables show, in the vehicle's own frames and SI units: position in
/// the frame set at take-off, attitude as right-handed roll, pitch, yaw.
struct VehicleState {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;  ///< above the ground below
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< nose down positive, unlike stateEstimate.pitch
  double yaw_rad = 0.0;
  double vx_body_m_s = 0.0;
  double vy_body_m_s = 0.0;
  double ax_body_m_s2 = 0.0;
  double ay_body_m_s2 = 0.0;
  double yaw_rate_rad_s = 0.0;
  double position_variance_m2 = 0.0;
  double yaw_variance_rad2 = 0.0;
  double front_mm = 0.0;  ///< as range.* shows them; 0 before the first measurement
  double back_mm = 0.0;
  double left_mm = 0.0;
  double right_mm = 0.0;
  double up_mm = 0.0;
  double down_mm = 0.0;
  double ground_m = 0.0;      ///< elevation of the ground below, relative to the lowest storey
  double baro_error_m = 0.0;  ///< of the barometer's altitude
  double battery_v = 0.0;
  double battery_percent = 0.0;
  double rssi_db = 0.0;  ///< positive: 45 stands for -45 dBm
  bool is_flying = false;
  bool battery_is_low = false;
};

struct LogVariable {
  std::string_view group;
  std::string_view name;
  LogType type;
  double (*live)(const VehicleState&) = nullptr;  ///< nullptr: its value never changes
  double constant = 0.0;

  /// In the variable's own unit, before conversion to its type.
  [[nodiscard]] double read(const VehicleState& state) const {
    return live != nullptr ? live(state) : constant;
  }
};

/// The log variables of the simulated vehicle; the id of each is its index.
[[nodiscard]] std::span<const LogVariable> simulated_log_table();

/// A key that changes with the table (CRC-32 over types and names in order).
[[nodiscard]] std::uint32_t simulated_log_table_crc();

}  // namespace swiftlet
