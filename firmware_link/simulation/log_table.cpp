// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/log_table.hpp"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/geometry/angle.hpp"
#include "firmware_link/simulation/members.hpp"
#include "firmware_link/simulation/platform.hpp"
#include "firmware_link/simulation/vehicle_motion.hpp"

namespace swiftlet {
namespace {

constexpr double kGyroCounts = 16.4;  // per degree per second
constexpr double kGroundAboveSeaM = 50.0;
constexpr double kVelocityVar = 2e-3;  // (m/s)^2, the filter's own estimate

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

/// Of each motor, of 65535.
double hover_thrust(const State& s) { return s.is_flying ? 38'000.0 : 0.0; }

constexpr LogVariable kLive[] = {
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
    {"supervisor", "info", kUint16, [](const State& s) -> double { return supervisor_info(s.is_flying); }},
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
    {"kalman", "varZ", kFloat, [](const State& s) { return s.position_variance_m2; }},
    {"kalman", "q0", kFloat, [](const State& s) { return quaternion(s)[3]; }},
    {"kalman", "q1", kFloat, [](const State& s) { return quaternion(s)[0]; }},
    {"kalman", "q2", kFloat, [](const State& s) { return quaternion(s)[1]; }},
    {"kalman", "q3", kFloat, [](const State& s) { return quaternion(s)[2]; }},
    {"sensfusion6", "qw", kFloat, [](const State& s) { return quaternion(s)[3]; }},
    {"sensfusion6", "qx", kFloat, [](const State& s) { return quaternion(s)[0]; }},
    {"sensfusion6", "qy", kFloat, [](const State& s) { return quaternion(s)[1]; }},
    {"sensfusion6", "qz", kFloat, [](const State& s) { return quaternion(s)[2]; }},
    {"gyro", "zRaw", kInt16, [](const State& s) { return degrees(s.yaw_rate_rad_s) * kGyroCounts; }},
    {"baro", "asl", kFloat,
     [](const State& s) { return kGroundAboveSeaM + s.ground_m + s.z_m + s.baro_error_m; }},
    {"posEstAlt", "estimatedZ", kFloat, [](const State& s) { return s.z_m; }},
    {"posCtl", "bodyX", kFloat, [](const State& s) { return s.x_m; }},
    {"posCtl", "bodyY", kFloat, [](const State& s) { return s.y_m; }},
    {"posCtl", "bodyVX", kFloat, [](const State& s) { return s.vx_body_m_s; }},
    {"posCtl", "bodyVY", kFloat, [](const State& s) { return s.vy_body_m_s; }},
    {"ctrltarget", "x", kFloat, [](const State& s) { return s.x_m; }},
    {"ctrltarget", "y", kFloat, [](const State& s) { return s.y_m; }},
    {"ctrltarget", "z", kFloat, [](const State& s) { return s.z_m; }},
    {"ctrltarget", "yaw", kFloat, [](const State& s) { return degrees(s.yaw_rad); }},
    {"ctrltargetZ", "x", kInt16, [](const State& s) { return s.x_m * 1000.0; }},
    {"ctrltargetZ", "y", kInt16, [](const State& s) { return s.y_m * 1000.0; }},
    {"ctrltargetZ", "z", kInt16, [](const State& s) { return s.z_m * 1000.0; }},
    {"controller", "yaw", kFloat, [](const State& s) { return degrees(s.yaw_rad); }},
    {"controller", "yawRate", kFloat, [](const State& s) { return degrees(s.yaw_rate_rad_s); }},
    {"controller", "r_yaw", kFloat, [](const State& s) { return s.yaw_rate_rad_s; }},
    {"controller", "actuatorThrust", kFloat, hover_thrust},
    {"controller", "cmd_thrust", kFloat, hover_thrust},
    {"stabilizer", "thrust", kFloat, hover_thrust},
    {"motor", "m1", kUint32, hover_thrust},
    {"motor", "m2", kUint32, hover_thrust},
    {"motor", "m3", kUint32, hover_thrust},
    {"motor", "m4", kUint32, hover_thrust},
    {"motor", "m1req", kInt32, hover_thrust},
    {"motor", "m2req", kInt32, hover_thrust},
    {"motor", "m3req", kInt32, hover_thrust},
    {"motor", "m4req", kInt32, hover_thrust},
    {"sys", "armed", kInt8, [](const State&) { return 1.0; }},
};

/// Variables of one group and type that the simulation does not model; `members`: names, each with its
/// constant value unless that is 0.
struct LogFamily {
  std::string_view group;
  LogType type;
  std::string_view members;
};

constexpr LogFamily kConstant[] = {
    {"activeMarker", kUint8, "btSns i2cOk"},
    {"motion", kUint8, "maxRaw=90 minRaw=20 Rawsum=50 outlierCount squal=60"},
    {"motion", kUint16, "shutter=900"},
    {"motion", kFloat, "std=2"},
    {"ring", kFloat, "fadeTime=0.5"},
    {"loco", kUint8, "mode"},
    {"loco", kFloat, "spiWr spiRe"},
    {"ranging", kUint16, "state"},
    {"ranging", kFloat,
     "distance0 distance1 distance2 distance3 distance4 distance5 distance6 distance7 pressure0 pressure1 "
     "pressure2 "
     "pressure3 pressure4 pressure5 pressure6 pressure7"},
    {"tdoa2", kFloat, "d7-0 d0-1 d1-2 d2-3 d3-4 d4-5 d5-6 d6-7 cc0 cc1 cc2 cc3 cc4 cc5 cc6 cc7"},
    {"tdoa2", kUint16, "dist7-0 dist0-1 dist1-2 dist2-3 dist3-4 dist4-5 dist5-6 dist6-7"},
    {"twr", kUint8,
     "rangingSuccessRate0 rangingPerSec0 rangingSuccessRate1 rangingPerSec1 rangingSuccessRate2 "
     "rangingPerSec2 "
     "rangingSuccessRate3 rangingPerSec3 rangingSuccessRate4 rangingPerSec4 rangingSuccessRate5 "
     "rangingPerSec5"},
    {"usd", kFloat, "spiWrBps spiReBps fatWrBps"},
    {"gyro", kInt16, "xRaw yRaw"},
    {"gyro", kFloat, "xVariance=0.01 yVariance=0.01 zVariance=0.01"},
    {"ext_pos", kFloat, "X Y Z"},
    {"locSrv", kFloat, "x y z qx qy qz qw"},
    {"locSrvZ", kUint16, "tick"},
    {"crtp", kUint16, "rxRate=100 txRate=20"},
    {"radio", kUint16, "numRxBc numRxUc"},
    {"health", kFloat,
     "motorVarXM1 motorVarYM1 motorVarXM2 motorVarYM2 motorVarXM3 motorVarYM3 motorVarXM4 motorVarYM4 "
     "batterySag"},
    {"health", kUint8, "motorPass batteryPass"},
    {"health", kUint16, "motorTestCount"},
    {"memTst", kUint32, "errCntW"},
    {"sensfusion6", kFloat, "gravityX gravityY gravityZ=1 accZbase=1"},
    {"sensfusion6", kUint8, "isInit=1 isCalibrated=1"},
    {"baro", kFloat, "temp=25 pressure=1007"},
    {"controller", kInt16, "ctr_yaw"},
    {"controller", kFloat,
     "cmd_roll cmd_pitch cmd_yaw r_roll r_pitch accelz=1 roll pitch rollRate pitchRate"},
    {"ctrltarget", kFloat, "vx vy vz ax ay az roll pitch"},
    {"ctrltargetZ", kInt16, "vx vy vz ax ay az"},
    {"mag", kFloat, "x=0.2 y z=-0.4"},
    {"stabilizer", kFloat, "rtStab=1000"},
    {"stabilizer", kUint32, "intToOut=900"},
    {"sys", kInt8, "testLogParam"},
    {"tdoaEngine", kFloat, "stRx stEst stTime stFound stCc stHit stMiss cc tdoa"},
    {"tdoaEngine", kUint16, "tof"},
    {"kalman_pred", kFloat, "predNX predNY measNX measNY"},
    {"lighthouse", kUint8, "validAngles comSync status"},
    {"lighthouse", kFloat,
     "rawAngle0x rawAngle0y rawAngle1x rawAngle1y angle0x angle0y angle1x angle1y angle0x_1 angle0y_1 "
     "angle1x_1 "
     "angle1y_1 angle0x_2 angle0y_2 angle1x_2 angle1y_2 angle0x_3 angle0y_3 angle1x_3 angle1y_3 "
     "rawAngle0xlh2 "
     "rawAngle0ylh2 rawAngle1xlh2 rawAngle1ylh2 angle0x_0lh2 angle0y_0lh2 angle1x_0lh2 angle1y_0lh2 posRt "
     "estBs0Rt "
     "estBs1Rt x y z delta disProb"},
    {"lighthouse", kUint16,
     "width0 width1 width2 width3 bsAvailable bsReceive bsActive bsCalUd bsCalCon bsGeoVal bsCalVal"},
    {"pid_attitude", kFloat,
     "roll_outP roll_outI roll_outD roll_outFF pitch_outP pitch_outI pitch_outD pitch_outFF yaw_outP "
     "yaw_outI yaw_outD "
     "yaw_outFF"},
    {"pid_rate", kFloat,
     "roll_outP roll_outI roll_outD roll_outFF pitch_outP pitch_outI pitch_outD pitch_outFF yaw_outP "
     "yaw_outI yaw_outD "
     "yaw_outFF"},
    {"ctrlMel", kFloat,
     "cmd_thrust cmd_roll cmd_pitch cmd_yaw r_roll r_pitch r_yaw accelz zdx zdy zdz i_err_x i_err_y i_err_z"},
    {"posCtl", kFloat,
     "targetVX targetVY targetVZ targetX targetY targetZ Xp Xi Xd Xff Yp Yi Yd Yff Zp Zi Zd Zff VXp VXi VXd "
     "VXff VYp "
     "VYi VYd VYff VZp VZi VZd VZff"},
    {"kalman", kFloat,
     "stateD0 stateD1 stateD2 varPZ=0.002 varD0 varD1 rtUpdate=100 rtPred=100 rtFinal=1000"},
    {"outlierf", kInt32, "lhWin"},
    {"estimator", kFloat, "rtApnd=200 rtRej"},
    {"posEstAlt", kFloat, "estVZ velocityZ"},
};

std::vector<LogVariable> make_log_table() {
  std::vector<LogVariable> table(std::begin(kLive), std::end(kLive));
  for (const LogFamily& family : kConstant)
    for_each_member(family.members, [&](std::string_view name, double shown) {
      table.push_back({family.group, name, family.type, nullptr, shown});
    });
  return table;
}

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

std::span<const LogVariable> simulated_log_table() {
  static const std::vector<LogVariable> kTable = make_log_table();
  return kTable;
}

std::uint32_t simulated_log_table_crc() {
  boost::crc_32_type crc;
  for (const LogVariable& variable : simulated_log_table()) {
    crc.process_byte(static_cast<unsigned char>(variable.type));
    crc.process_bytes(variable.group.data(), variable.group.size());
    crc.process_byte(0);
    crc.process_bytes(variable.name.data(), variable.name.size());
    crc.process_byte(0);
  }
  return crc.checksum();
}

}  // namespace swiftlet
