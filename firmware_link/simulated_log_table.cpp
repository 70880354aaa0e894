// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_log_table.hpp"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kGravity = 9.81;      // m/s^2
constexpr double kVelocityVar = 2e-3;  // (m/s)^2, what the filter believes of its velocity

using State = VehicleState;
using enum LogType;

double vx_world_m_s(const State& s) {
  return std::cos(s.yaw_rad) * s.vx_body_m_s - std::sin(s.yaw_rad) * s.vy_body_m_s;
}
double vy_world_m_s(const State& s) {
  return std::sin(s.yaw_rad) * s.vx_body_m_s + std::cos(s.yaw_rad) * s.vy_body_m_s;
}
double ax_world_m_s2(const State& s) {
  return std::cos(s.yaw_rad) * s.ax_body_m_s2 - std::sin(s.yaw_rad) * s.ay_body_m_s2;
}
double ay_world_m_s2(const State& s) {
  return std::sin(s.yaw_rad) * s.ax_body_m_s2 + std::cos(s.yaw_rad) * s.ay_body_m_s2;
}

/// Body to world, right-handed, in the order x, y, z, w.
std::array<double, 4> quaternion(const State& s) {
  const double cr = std::cos(s.roll_rad / 2.0);
  const double sr = std::sin(s.roll_rad / 2.0);
  const double cp = std::cos(s.pitch_rad / 2.0);
  const double sp = std::sin(s.pitch_rad / 2.0);
  const double cy = std::cos(s.yaw_rad / 2.0);
  const double sy = std::sin(s.yaw_rad / 2.0);
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

/// stateEstimateZ.quat: which component is largest (2 bits, made positive and left out), then sign bit and
/// 9-bit magnitude of each of the others, 511 standing for 1 / sqrt(2).
double compressed_quaternion(const State& s) {
  const std::array<double, 4> q = quaternion(s);
  std::size_t largest = 0;
  for (std::size_t i = 1; i < q.size(); ++i)
    if (std::abs(q[i]) > std::abs(q[largest])) largest = i;
  auto packed = static_cast<std::uint32_t>(largest);
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (i == largest) continue;
    const bool is_negative = (q[i] < 0.0) != (q[largest] < 0.0);
    const double magnitude = std::round(std::abs(q[i]) * std::sqrt(2.0) * 511.0);
    packed =
        packed << 10U | (is_negative ? 0x200U : 0U) | std::min(511U, static_cast<std::uint32_t>(magnitude));
  }
  return packed;
}

/// Counts of the flow sensor in one 10 ms read along a body axis: 35 pixels see 0.71674 rad, ten counts each.
double flow_counts(double velocity_m_s, double height_m) {
  return std::round(velocity_m_s * 0.01 / std::max(height_m, 0.1) * (350.0 / 0.71674));
}

constexpr LogVariable kTable[] = {
    {"range", "front", kUint16, [](const State& s) { return s.front_mm; }},
    {"range", "back", kUint16, [](const State& s) { return s.back_mm; }},
    {"range", "up", kUint16, [](const State& s) { return s.up_mm; }},
    {"range", "left", kUint16, [](const State& s) { return s.left_mm; }},
    {"range", "right", kUint16, [](const State& s) { return s.right_mm; }},
    {"range", "zrange", kUint16, [](const State& s) { return s.down_mm; }},
    {"pm", "vbat", kFloat, [](const State& s) { return s.battery_v; }},
    {"pm", "vbatMV", kUint16, [](const State& s) { return std::floor(s.battery_v * 1000.0); }},
    {"pm", "extVbat", kFloat, [](const State&) { return 0.0; }},
    {"pm", "extVbatMV", kUint16, [](const State&) { return 0.0; }},
    {"pm", "extCurr", kFloat, [](const State&) { return 0.0; }},
    {"pm", "chargeCurrent", kFloat, [](const State&) { return 0.0; }},
    {"pm", "state", kInt8, [](const State& s) { return s.battery_is_low ? 3.0 : 0.0; }},
    {"pm", "batteryLevel", kUint8,
     [](const State& s) { return std::min(90.0, std::floor(s.battery_percent / 10.0) * 10.0); }},
    {"radio", "rssi", kUint8, [](const State& s) { return std::round(s.rssi_db); }},
    {"radio", "isConnected", kUint8, [](const State&) { return 1.0; }},
    {"sys", "canfly", kUint8, [](const State&) { return 1.0; }},
    {"sys", "isFlying", kUint8, [](const State& s) { return s.is_flying ? 1.0 : 0.0; }},
    {"sys", "isTumbled", kUint8, [](const State&) { return 0.0; }},
    // Can arm, armed, arms itself, can fly; flying.
    {"supervisor", "info", kUint16, [](const State& s) -> double { return s.is_flying ? 0x1F : 0x0F; }},
    {"motion", "motion", kUint8, [](const State& s) -> double { return s.is_flying ? 0xB0 : 0x00; }},
    {"motion", "deltaX", kInt16, [](const State& s) { return -flow_counts(s.vy_body_m_s, s.z_m); }},
    {"motion", "deltaY", kInt16, [](const State& s) { return -flow_counts(s.vx_body_m_s, s.z_m); }},
    {"gyro", "x", kFloat, [](const State&) { return 0.0; }},
    {"gyro", "y", kFloat, [](const State&) { return 0.0; }},
    {"gyro", "z", kFloat, [](const State& s) { return degrees(s.yaw_rate_rad_s); }},
    {"acc", "x", kFloat, [](const State& s) { return s.ax_body_m_s2 / kGravity; }},
    {"acc", "y", kFloat, [](const State& s) { return s.ay_body_m_s2 / kGravity; }},
    {"acc", "z", kFloat, [](const State&) { return 1.0; }},
    {"stabilizer", "roll", kFloat, [](const State& s) { return degrees(s.roll_rad); }},
    {"stabilizer", "pitch", kFloat, [](const State& s) { return -degrees(s.pitch_rad); }},
    {"stabilizer", "yaw", kFloat, [](const State& s) { return degrees(s.yaw_rad); }},
    {"stateEstimate", "x", kFloat, [](const State& s) { return s.x_m; }},
    {"stateEstimate", "y", kFloat, [](const State& s) { return s.y_m; }},
    {"stateEstimate", "z", kFloat, [](const State& s) { return s.z_m; }},
    {"stateEstimate", "vx", kFloat, vx_world_m_s},
    {"stateEstimate", "vy", kFloat, vy_world_m_s},
    {"stateEstimate", "vz", kFloat, [](const State&) { return 0.0; }},
    {"stateEstimate", "ax", kFloat, [](const State& s) { return ax_world_m_s2(s) / kGravity; }},
    {"stateEstimate", "ay", kFloat, [](const State& s) { return ay_world_m_s2(s) / kGravity; }},
    {"stateEstimate", "az", kFloat, [](const State&) { return 0.0; }},
    {"stateEstimate", "roll", kFloat, [](const State& s) { return degrees(s.roll_rad); }},
    {"stateEstimate", "pitch", kFloat, [](const State& s) { return -degrees(s.pitch_rad); }},
    {"stateEstimate", "yaw", kFloat, [](const State& s) { return degrees(s.yaw_rad); }},
    {"stateEstimate", "qx", kFloat, [](const State& s) { return quaternion(s)[0]; }},
    {"stateEstimate", "qy", kFloat, [](const State& s) { return quaternion(s)[1]; }},
    {"stateEstimate", "qz", kFloat, [](const State& s) { return quaternion(s)[2]; }},
    {"stateEstimate", "qw", kFloat, [](const State& s) { return quaternion(s)[3]; }},
    {"stateEstimateZ", "x", kInt16, [](const State& s) { return s.x_m * 1000.0; }},
    {"stateEstimateZ", "y", kInt16, [](const State& s) { return s.y_m * 1000.0; }},
    {"stateEstimateZ", "z", kInt16, [](const State& s) { return s.z_m * 1000.0; }},
    {"stateEstimateZ", "vx", kInt16, [](const State& s) { return vx_world_m_s(s) * 1000.0; }},
    {"stateEstimateZ", "vy", kInt16, [](const State& s) { return vy_world_m_s(s) * 1000.0; }},
    {"stateEstimateZ", "vz", kInt16, [](const State&) { return 0.0; }},
    {"stateEstimateZ", "ax", kInt16, [](const State& s) { return ax_world_m_s2(s) * 1000.0; }},
    {"stateEstimateZ", "ay", kInt16, [](const State& s) { return ay_world_m_s2(s) * 1000.0; }},
    {"stateEstimateZ", "az", kInt16, [](const State&) { return kGravity * 1000.0; }},
    {"stateEstimateZ", "quat", kUint32, compressed_quaternion},
    {"stateEstimateZ", "rateRoll", kInt16, [](const State&) { return 0.0; }},
    {"stateEstimateZ", "ratePitch", kInt16, [](const State&) { return 0.0; }},
    {"stateEstimateZ", "rateYaw", kInt16, [](const State& s) { return s.yaw_rate_rad_s * 1000.0; }},
    {"kalman", "stateX", kFloat, [](const State& s) { return s.x_m; }},
    {"kalman", "stateY", kFloat, [](const State& s) { return s.y_m; }},
    {"kalman", "stateZ", kFloat, [](const State& s) { return s.z_m; }},
    {"kalman", "statePX", kFloat, [](const State& s) { return s.vx_body_m_s; }},
    {"kalman", "statePY", kFloat, [](const State& s) { return s.vy_body_m_s; }},
    {"kalman", "statePZ", kFloat, [](const State&) { return 0.0; }},
    {"kalman", "varX", kFloat, [](const State& s) { return s.position_variance_m2; }},
    {"kalman", "varY", kFloat, [](const State& s) { return s.position_variance_m2; }},
    {"kalman", "varPX", kFloat, [](const State&) { return kVelocityVar; }},
    {"kalman", "varPY", kFloat, [](const State&) { return kVelocityVar; }},
    {"kalman", "varD2", kFloat, [](const State& s) { return s.yaw_variance_rad2; }},
    {"kalman", "q0", kFloat, [](const State& s) { return quaternion(s)[3]; }},
    {"kalman", "q1", kFloat, [](const State& s) { return quaternion(s)[0]; }},
    {"kalman", "q2", kFloat, [](const State& s) { return quaternion(s)[1]; }},
    {"kalman", "q3", kFloat, [](const State& s) { return quaternion(s)[2]; }},
};

}  // namespace

std::size_t log_type_size(LogType type) {
  switch (type) {
    case kUint8:
    case kInt8:
      return 1;
    case kUint16:
    case kInt16:
    case kHalf:
      return 2;
    case kUint32:
    case kInt32:
    case kFloat:
      return 4;
  }
  return 0;
}

std::span<const LogVariable> simulated_log_table() { return kTable; }

std::uint32_t simulated_log_table_crc() {
  boost::crc_32_type crc;
  for (const LogVariable& variable : kTable) {
    crc.process_byte(static_cast<unsigned char>(variable.type));
    crc.process_bytes(variable.group.data(), variable.group.size());
    crc.process_byte(0);
    crc.process_bytes(variable.name.data(), variable.name.size());
    crc.process_byte(0);
  }
  return crc.checksum();
}

}  // namespace swiftlet
