// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/odometry.hpp"

#include <cmath>

namespace swiftlet {
namespace {

constexpr double kYawPull = 0.001;  // of the way, each step

}  // namespace

FlowOdometry::FlowOdometry(const FlowOdometryModel& model, std::uint64_t seed)
    : model_(model),
      flow_noise_(seed, "flow"),
      gyro_noise_(seed, "gyro"),
      slip_noise_(seed, "slip"),
      jump_noise_(seed, "yaw_jump"),
      scale_(1.0 + flow_noise_.uniform(-model.scale_spread, model.scale_spread)),
      yaw_bias_rad_s_(
          gyro_noise_.either_sign(gyro_noise_.uniform(model.yaw_bias_min_rad_s, model.yaw_bias_max_rad_s))),
      turn_scale_(1.0 + gyro_noise_.uniform(-model.turn_scale_spread, model.turn_scale_spread)) {}

/// The share of the motion that the flow sensor measures now.
double FlowOdometry::seen_share() {
  slip_left_s_ -= kFlightStepS;
  if (slip_left_s_ > 0.0) return slip_share_;
  if (!slip_noise_.chance(model_.slips_per_s * kFlightStepS)) return 1.0;
  slip_left_s_ = slip_noise_.uniform(model_.slip_min_s, model_.slip_max_s);
  slip_share_ = slip_noise_.uniform(model_.slip_seen_min_share, model_.slip_seen_max_share);
  return slip_share_;
}

/// Of the patches that lie on each other, the first counts.
double FlowOdometry::floor_share(const Point2& at) const {
  for (const FloorPatch& patch : model_.floor_patches)
    if (distance_m(at, patch.centre) < patch.radius_m) return patch.seen_share;
  return 1.0;
}

double FlowOdometry::yaw_jump_rad() {
  if (model_.yaw_jumps_per_s == 0.0 || !jump_noise_.chance(model_.yaw_jumps_per_s * kFlightStepS)) return 0.0;
  return jump_noise_.either_sign(jump_noise_.uniform(model_.yaw_jump_min_rad, model_.yaw_jump_max_rad));
}

void FlowOdometry::step(const FlightState& truth, bool has_flow) {
  if (truth.height_m <= 0.0) {
    vx_body_m_s_ = vy_body_m_s_ = yaw_rate_rad_s_ = 0.0;
    return;
  }
  const double keep = std::exp(-kFlightStepS / model_.scale_wander_time_s);
  scale_error_ =
      keep * scale_error_ + flow_noise_.gaussian(model_.scale_wander * std::sqrt(1.0 - keep * keep));
  const double share = seen_share() * (scale_ + scale_error_) * floor_share(truth.T_world_body.position());
  const double forward_m_s = model_.loses_reverse_sign ? std::abs(truth.vx_body_m_s) : truth.vx_body_m_s;
  vx_body_m_s_ = share * forward_m_s + flow_noise_.gaussian(model_.velocity_noise_m_s);
  vy_body_m_s_ = share * truth.vy_body_m_s + flow_noise_.gaussian(model_.velocity_noise_m_s);
  if (!has_flow) vx_body_m_s_ = vy_body_m_s_ = 0.0;
  yaw_rate_rad_s_ = turn_scale_ * truth.yaw_rate_rad_s + yaw_bias_rad_s_;
  const double turned_rad = yaw_rate_rad_s_ * kFlightStepS +
                            gyro_noise_.gaussian(model_.yaw_walk_rad_sqrt_s * std::sqrt(kFlightStepS)) +
                            yaw_jump_rad();
  T_odom_body_ = T_odom_body_ * Pose2(vx_body_m_s_ * kFlightStepS, vy_body_m_s_ * kFlightStepS, turned_rad);
  const double step_sigma_m = model_.velocity_noise_m_s * kFlightStepS;
  position_variance_m2_ += step_sigma_m * step_sigma_m;
  yaw_variance_rad2_ += model_.yaw_walk_rad_sqrt_s * model_.yaw_walk_rad_sqrt_s * kFlightStepS;
}

void FlowOdometry::pull_yaw(double initial_yaw_rad) {
  const Pose2& was = T_odom_body_;
  const double pull = kYawPull * wrap_angle(initial_yaw_rad - was.yaw_rad());
  T_odom_body_ = Pose2(was.x_m(), was.y_m(), was.yaw_rad() + pull);
}

void FlowOdometry::reset(const Pose2& T_odom_body) {
  T_odom_body_ = T_odom_body;
  vx_body_m_s_ = vy_body_m_s_ = yaw_rate_rad_s_ = 0.0;
  position_variance_m2_ = yaw_variance_rad2_ = 0.0;
}

}  // namespace swiftlet
