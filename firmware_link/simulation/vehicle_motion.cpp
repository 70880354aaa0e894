// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/vehicle_motion.hpp"

#include <cmath>

namespace swiftlet {
namespace {

constexpr double kVelocityResponseS = 0.3;   // velocity follows the command with this time constant
constexpr double kMaxAcceleration = 1.2;     // m/s^2
constexpr double kMaxYawAcceleration = 4.0;  // rad/s^2

}  // namespace

void VehicleMotion::step(double vx_m_s, double vy_m_s, double yaw_rate_rad_s) {
  double ax = (vx_m_s - vx_m_s_) / kVelocityResponseS;
  double ay = (vy_m_s - vy_m_s_) / kVelocityResponseS;
  const double excess = std::hypot(ax, ay) / kMaxAcceleration;
  if (excess > 1.0) {
    ax /= excess;
    ay /= excess;
  }
  vx_m_s_ += ax * kFlightStepS;
  vy_m_s_ += ay * kFlightStepS;
  state_.yaw_rate_rad_s +=
      limited(yaw_rate_rad_s - state_.yaw_rate_rad_s, kMaxYawAcceleration * kFlightStepS);
  const Pose2& was = state_.T_world_body;
  state_.T_world_body = Pose2(was.x_m() + vx_m_s_ * kFlightStepS, was.y_m() + vy_m_s_ * kFlightStepS,
                              was.yaw_rad() + state_.yaw_rate_rad_s * kFlightStepS);
  const double c = state_.T_world_body.cos_yaw();
  const double s = state_.T_world_body.sin_yaw();
  state_.vx_body_m_s = c * vx_m_s_ + s * vy_m_s_;
  state_.vy_body_m_s = -s * vx_m_s_ + c * vy_m_s_;
  state_.ax_body_m_s2 = c * ax + s * ay;
  state_.ay_body_m_s2 = -s * ax + c * ay;
}

}  // namespace swiftlet
