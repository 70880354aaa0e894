// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/steered_flight.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "core/geometry/angle.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(SteeredFlightTest, ReadsHoverInBothVersionsAndStop) {
  const HoverSetpoint setpoint{
      .vx_body_m_s = 0.5, .vy_body_m_s = -0.25, .yaw_rate_rad_s = radians(30.0), .height_m = 0.75};
  CrtpPacket packet = hover_packet(setpoint);
  EXPECT_EQ(packet.size(), 18U);
  EXPECT_EQ(packet[0], 0x7C);
  const auto read = read_setpoint(bytes_of(packet));
  ASSERT_TRUE(read);
  EXPECT_DOUBLE_EQ(read->vx_body_m_s, 0.5);
  EXPECT_DOUBLE_EQ(read->vy_body_m_s, -0.25);
  EXPECT_NEAR(read->yaw_rate_rad_s, radians(30.0), 1e-6);
  EXPECT_DOUBLE_EQ(read->height_m, 0.75);
  packet[1] = 5;
  EXPECT_NEAR(read_setpoint(bytes_of(packet))->yaw_rate_rad_s, radians(-30.0), 1e-6);
  packet[1] = 7;
  EXPECT_FALSE(read_setpoint(bytes_of(packet))) << "of positions";
  EXPECT_EQ(read_setpoint(bytes_of(make_crtp_packet({7, 0}, {0})))->height_m, 0.0);
  EXPECT_FALSE(read_setpoint(bytes_of(make_crtp_packet({7, 1}, {0}))));
}

class SteeredFlying : public testing::Test {
 protected:
  void fly(const HoverSetpoint& setpoint, Duration duration) {
    for (const Duration end = now_ + duration; now_ < end; now_ += milliseconds(10)) {
      flight_.take(setpoint, now_);
      flight_.advance(now_);
    }
  }
  void wait(Duration duration) { flight_.advance(now_ += duration); }

  Duration now_ = seconds(5);
  SteeredFlight flight_{Pose2(1.0, 2.0, kPi / 2.0), now_};
};

TEST_F(SteeredFlying, TakesOffAndFollowsItsSetpoints) {
  fly({.vx_body_m_s = 1.0}, seconds(1));
  EXPECT_EQ(flight_.state().T_world_body.position().y_m, 2.0) << "on the ground nothing moves it";
  fly({.height_m = 0.5}, seconds(3));
  EXPECT_NEAR(flight_.state().height_m, 0.5, 1e-9);
  fly({.vx_body_m_s = 0.5, .height_m = 0.5}, seconds(4));
  EXPECT_NEAR(flight_.state().T_world_body.x_m(), 1.0, 1e-9);
  EXPECT_NEAR(flight_.state().T_world_body.y_m(), 2.0 + 0.5 * 3.7, 0.05);
  fly({.yaw_rate_rad_s = 0.5, .height_m = 0.5}, seconds(2));
  EXPECT_NEAR(flight_.state().T_world_body.yaw_rad(), kPi / 2.0 + 1.0, 0.05);
  EXPECT_NEAR(to_seconds(flight_.flown()), 9.0, 0.1);
}

TEST_F(SteeredFlying, WithoutSetpointsItStopsAndThenComesDown) {
  fly({.vx_body_m_s = 0.5, .height_m = 0.5}, seconds(4));
  wait(milliseconds(400));
  EXPECT_NEAR(flight_.state().vx_body_m_s, 0.5, 0.02);
  wait(milliseconds(1500));
  EXPECT_NEAR(flight_.state().vx_body_m_s, 0.0, 0.02);
  EXPECT_NEAR(flight_.state().height_m, 0.5, 1e-9);
  wait(seconds(2));
  EXPECT_EQ(flight_.state().height_m, 0.0);
}

TEST_F(SteeredFlying, RemembersWhereItWas) {
  fly({.height_m = 0.5}, seconds(3));
  fly({.vx_body_m_s = 0.5, .height_m = 0.5}, seconds(3));
  const double y_m = flight_.T_world_body(now_ - milliseconds(10)).y_m();
  EXPECT_NEAR(flight_.T_world_body(now_ - milliseconds(95)).y_m(), y_m - 0.0425, 1e-3);
  EXPECT_EQ(flight_.T_world_body(now_ + seconds(1)).y_m(), y_m);
  EXPECT_EQ(flight_.T_world_body(now_ - seconds(5)).y_m(), flight_.T_world_body(now_ - seconds(2)).y_m());
}

TEST(SteeredVehicle, StandsUntilItIsSteeredWhateverIsLogged) {
  VehicleModel model;
  model.is_steered = true;
  SimulatedVehicle vehicle(make_simulated_world("office").value(), model, 1);
  const double x_m = vehicle.T_world_body(vehicle.now()).x_m();
  CrtpPacket create = log_block_request(LogCommand::kCreate, 1);
  ASSERT_TRUE(add_log_entry(create, 7, 0));
  static_cast<void>(vehicle.handle(bytes_of(create)));
  static_cast<void>(vehicle.handle(bytes_of(log_start_request(1, 10))));
  EXPECT_GT(vehicle.advance(vehicle.now() + seconds(5)).size(), 45U);
  EXPECT_FALSE(vehicle.is_flying());
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(vehicle.handle(bytes_of(hover_packet({.vy_body_m_s = 0.3, .height_m = 0.5}))));
    static_cast<void>(vehicle.advance(vehicle.now() + milliseconds(50)));
  }
  EXPECT_TRUE(vehicle.is_flying());
  EXPECT_FALSE(vehicle.is_finished());
  const Pose2 T_world_body = vehicle.T_world_body(vehicle.now());
  EXPECT_GT(std::hypot(T_world_body.x_m() - x_m, 0.0) + std::abs(T_world_body.y_m()), 0.5);
}

}  // namespace
}  // namespace swiftlet
