// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/flight.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// The errors of flow sensor and gyro. Calibrated on the two reference flights, raw odometry against the
/// published corrected trajectories: olsson (294 m in 377 s) and rice (192 m in 311 s). Heading: changes of
/// the error from minute to minute of 5 and 7 degrees (standard deviation), 19 and 23 degrees between its
/// extremes, 15 degrees left at the end of olsson. Scale: 0.992 and 0.999, +-3 % and +-2 % from one 3 m chord
/// to the next. Position after rigid alignment: 1.30 and 1.02 m RMS. With the values below the simulated
/// flights (150 to 195 m in 6 to 7.5 minutes, seeds 1 to 10): heading 3 to 9 degrees from minute to minute,
/// 16 to 41 between extremes; position 0.6 to 1.5 m in the office, 0.5 to 0.9 in the maze, 0.7 to 2.1 in loop
/// and corridors.
struct FlowOdometryModel {
  double scale_spread = 0.008;       ///< constant scale error, evenly between plus and minus this
  double scale_wander = 0.02;        ///< of the floor underneath: standard deviation...
  double scale_wander_time_s = 6.0;  ///< ...and correlation time
  double velocity_noise_m_s = 0.05;  ///< white, at each step
  double yaw_bias_min_rad_s = radians(2.0) / 60.0;  ///< constant, of either sign, evenly between
  double yaw_bias_max_rad_s = radians(3.0) / 60.0;
  double yaw_walk_rad_sqrt_s = radians(0.6);  ///< random walk: standard deviation after one second
  double turn_scale_spread = 0.01;            ///< of the yaw rate, evenly between plus and minus this
  double slips_per_s = 1.0 / 90.0;            ///< stretches where the flow sensor misses part of the motion
  double slip_min_s = 0.3;
  double slip_max_s = 1.0;
  double slip_seen_min_share = 0.3;  ///< of the motion, during a slip
  double slip_seen_max_share = 0.8;
  double yaw_jumps_per_s = 0.0;     ///< the heading jumps, unseen by the filter...
  double yaw_jump_min_rad = 0.0;    ///< ...by this, of either sign, ...
  double yaw_jump_max_rad = 0.0;    ///< ...to this, evenly between
  bool loses_reverse_sign = false;  ///< reverse motion is reported as forward
  std::vector<FloorPatch> floor_patches;
};

/// The vehicle's dead reckoning: integrates the true motion as measured by flow sensor and gyro. Noise
/// sources: "flow", "gyro", "slip", "yaw_jump", independent of each other.
class FlowOdometry {
 public:
  FlowOdometry(const FlowOdometryModel& model, std::uint64_t seed);

  /// The vehicle's estimate; identity at the start.
  [[nodiscard]] const Pose2& T_odom_body() const { return T_odom_body_; }
  [[nodiscard]] double vx_body_m_s() const { return vx_body_m_s_; }
  [[nodiscard]] double vy_body_m_s() const { return vy_body_m_s_; }
  [[nodiscard]] double yaw_rate_rad_s() const { return yaw_rate_rad_s_; }
  /// The filter's own estimates of its variance.
  [[nodiscard]] double position_variance_m2() const { return position_variance_m2_; }
  [[nodiscard]] double yaw_variance_rad2() const { return yaw_variance_rad2_; }

  /// One kFlightStep of the motion `truth`. On the ground (height 0) the estimate stays; without flow the
  /// position stays and only the heading is integrated.
  void step(const FlightState& truth, bool has_flow = true);
  /// One kFlightStep of the filter while it takes the vehicle for standing: the heading decays to the initial
  /// one, with a time constant of 10 s.
  void pull_yaw(double initial_yaw_rad);
  /// The filter restarts from that pose.
  void reset(const Pose2& T_odom_body);

 private:
  [[nodiscard]] double seen_share();
  [[nodiscard]] double floor_share(const Point2& at) const;
  [[nodiscard]] double yaw_jump_rad();

  FlowOdometryModel model_;
  NoiseSource flow_noise_;
  NoiseSource gyro_noise_;
  NoiseSource slip_noise_;
  NoiseSource jump_noise_;
  double scale_;
  double yaw_bias_rad_s_;
  double turn_scale_;
  double scale_error_ = 0.0;
  double slip_left_s_ = 0.0;
  double slip_share_ = 1.0;
  Pose2 T_odom_body_;
  double vx_body_m_s_ = 0.0;
  double vy_body_m_s_ = 0.0;
  double yaw_rate_rad_s_ = 0.0;
  double position_variance_m2_ = 0.0;
  double yaw_variance_rad2_ = 0.0;
};

}  // namespace swiftlet
