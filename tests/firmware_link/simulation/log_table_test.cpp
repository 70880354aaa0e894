// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/log_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

const LogVariable* find(const std::string& full_name) {
  for (const LogVariable& variable : simulated_log_table())
    if (std::string(variable.group) + "." + std::string(variable.name) == full_name) return &variable;
  return nullptr;
}

double read(const std::string& full_name, const VehicleState& state) {
  const LogVariable* const variable = find(full_name);
  if (variable == nullptr) {
    ADD_FAILURE() << "no variable " << full_name;
    return 0.0;
  }
  return variable->read(state);
}

/// Undoes the packing of stateEstimateZ.quat as the firmware's documentation describes it; x, y, z, w.
std::array<double, 4> unpacked(std::uint32_t packed) {
  const std::size_t largest = packed >> 30U;
  std::array<double, 4> q{};
  double squares = 0.0;
  for (std::size_t i = 4; i-- > 0;) {
    if (i == largest) continue;
    const double magnitude = (packed & 0x1FFU) / 511.0 / std::sqrt(2.0);
    q[i] = (packed & 0x200U) != 0 ? -magnitude : magnitude;
    squares += magnitude * magnitude;
    packed >>= 10U;
  }
  q[largest] = std::sqrt(1.0 - squares);
  return q;
}

TEST(LogTable, HasDistinctNamesThatFitTheWire) {
  std::set<std::string> names;
  for (const LogVariable& variable : simulated_log_table()) {
    EXPECT_TRUE(names.insert(std::string(variable.group) + "." + std::string(variable.name)).second);
    EXPECT_LE(variable.group.size() + variable.name.size(), 24U);
    EXPECT_GT(log_type_size(variable.type), 0U);
  }
  EXPECT_GE(names.size(), 390U);
}

TEST(LogTable, ShowsConstantsForVariablesThatAreNotSimulated) {
  VehicleState flying;
  flying.is_flying = true;
  for (const VehicleState& state : {VehicleState{}, flying}) {
    EXPECT_EQ(read("motion.squal", state), 60.0);
    EXPECT_EQ(read("ext_pos.X", state), 0.0);
  }
}

TEST(LogTable, OffersWhatSlamNeedsInTheFirmwaresTypes) {
  for (const char* name : {"stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw", "pm.vbat", "gyro.z"}) {
    ASSERT_NE(find(name), nullptr) << name;
    EXPECT_EQ(find(name)->type, LogType::kFloat) << name;
  }
  for (const char* name : {"range.front", "range.back", "range.left", "range.right", "range.up",
                           "range.zrange", "supervisor.info", "pm.vbatMV"}) {
    ASSERT_NE(find(name), nullptr) << name;
    EXPECT_EQ(find(name)->type, LogType::kUint16) << name;
  }
  ASSERT_NE(find("stateEstimateZ.x"), nullptr);
  EXPECT_EQ(find("stateEstimateZ.x")->type, LogType::kInt16);
  ASSERT_NE(find("stateEstimateZ.quat"), nullptr);
  EXPECT_EQ(find("stateEstimateZ.quat")->type, LogType::kUint32);
}

TEST(LogTable, ShowsPositionInMetresAndMillimetresAndYawInDegrees) {
  VehicleState state;
  state.x_m = 1.5;
  state.y_m = -0.25;
  state.yaw_rad = kPi / 2.0;
  EXPECT_EQ(read("stateEstimate.x", state), 1.5);
  EXPECT_EQ(read("stateEstimateZ.y", state), -250.0);
  EXPECT_NEAR(read("stateEstimate.yaw", state), 90.0, 1e-9);
}

TEST(LogTable, TurnsBodyVelocityIntoTheWorldFrame) {
  VehicleState state;
  state.yaw_rad = kPi / 2.0;
  state.vx_body_m_s = 0.5;
  EXPECT_NEAR(read("stateEstimate.vx", state), 0.0, 1e-12);
  EXPECT_NEAR(read("stateEstimate.vy", state), 0.5, 1e-12);
  EXPECT_EQ(read("kalman.statePX", state), 0.5);
}

TEST(LogTable, InvertsPitchButNotTheQuaternion) {
  VehicleState state;
  state.pitch_rad = 0.1;  // nose down
  EXPECT_NEAR(read("stateEstimate.pitch", state), -degrees(0.1), 1e-9);
  EXPECT_NEAR(read("stateEstimate.qy", state), std::sin(0.05), 1e-12);
}

TEST(LogTable, PacksTheQuaternionToWithinItsResolution) {
  for (const double yaw_rad : {-3.0, -1.6, -0.4, 0.0, 0.7, 1.5, 2.9}) {
    VehicleState state;
    state.roll_rad = 0.03;
    state.pitch_rad = -0.05;
    state.yaw_rad = yaw_rad;
    const auto q = unpacked(static_cast<std::uint32_t>(read("stateEstimateZ.quat", state)));
    const double sign = q[3] * read("stateEstimate.qw", state) < 0.0 ? -1.0 : 1.0;
    EXPECT_NEAR(sign * q[0], read("stateEstimate.qx", state), 2e-3);
    EXPECT_NEAR(sign * q[1], read("stateEstimate.qy", state), 2e-3);
    EXPECT_NEAR(sign * q[2], read("stateEstimate.qz", state), 2e-3);
    EXPECT_NEAR(sign * q[3], read("stateEstimate.qw", state), 2e-3);
  }
}

TEST(LogTable, ShowsTheAltitudeThatTheBarometerMeasures) {
  VehicleState state;
  const double on_ground_m = read("baro.asl", state);
  state.z_m = 0.5;
  state.ground_m = 3.2;
  state.baro_error_m = -0.1;
  EXPECT_NEAR(read("baro.asl", state), on_ground_m + 3.6, 1e-9);
  EXPECT_EQ(read("stateEstimate.z", state), 0.5) << "above the ground below";
}

TEST(LogTable, ShowsFlyingInTheSupervisorsBit) {
  VehicleState state;
  EXPECT_EQ(static_cast<unsigned>(read("supervisor.info", state)) & 0x10U, 0U);
  state.is_flying = true;
  EXPECT_EQ(static_cast<unsigned>(read("supervisor.info", state)) & 0x10U, 0x10U);
}

}  // namespace
}  // namespace swiftlet
