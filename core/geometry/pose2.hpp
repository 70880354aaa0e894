// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/point2.hpp"

namespace swiftlet {

/// Rigid motion of the plane, SE(2). Named by its frames, destination first: T_a_b * p_b == p_a and
/// T_a_b * T_b_c == T_a_c. Trivially copyable, so it may cross a queue. As a vector its order is (x, y, yaw).
class Pose2 {
 public:
  /// Identity.
  constexpr Pose2() = default;
  /// `yaw_rad` counter-clockwise; wrapped to [-pi, pi).
  Pose2(double x_m, double y_m, double yaw_rad)
      : x_m_(x_m),
        y_m_(y_m),
        yaw_rad_(wrap_angle(yaw_rad)),
        cos_yaw_(std::cos(yaw_rad_)),
        sin_yaw_(std::sin(yaw_rad_)) {}

  [[nodiscard]] double x_m() const { return x_m_; }
  [[nodiscard]] double y_m() const { return y_m_; }
  [[nodiscard]] double yaw_rad() const { return yaw_rad_; }
  [[nodiscard]] double cos_yaw() const { return cos_yaw_; }
  [[nodiscard]] double sin_yaw() const { return sin_yaw_; }
  [[nodiscard]] Point2 position() const { return {x_m_, y_m_}; }
  [[nodiscard]] Eigen::Vector3d vector() const { return {x_m_, y_m_, yaw_rad_}; }

  /// T_b_a of a T_a_b.
  [[nodiscard]] Pose2 inverse() const {
    Pose2 T_b_a;
    T_b_a.x_m_ = -cos_yaw_ * x_m_ - sin_yaw_ * y_m_;
    T_b_a.y_m_ = sin_yaw_ * x_m_ - cos_yaw_ * y_m_;
    T_b_a.yaw_rad_ = wrap_angle(-yaw_rad_);
    T_b_a.cos_yaw_ = cos_yaw_;  // half of all poses are inverses: without calling sine and cosine
    T_b_a.sin_yaw_ = -sin_yaw_;
    return T_b_a;
  }
  Pose2 operator*(const Pose2& T_b_c) const {
    const Point2 p = *this * T_b_c.position();
    return {p.x_m, p.y_m, yaw_rad_ + T_b_c.yaw_rad_};
  }
  Point2 operator*(const Point2& p_b) const {
    return {cos_yaw_ * p_b.x_m - sin_yaw_ * p_b.y_m + x_m_, sin_yaw_ * p_b.x_m + cos_yaw_ * p_b.y_m + y_m_};
  }

 private:
  double x_m_ = 0.0;
  double y_m_ = 0.0;
  double yaw_rad_ = 0.0;
  double cos_yaw_ = 1.0;
  double sin_yaw_ = 0.0;
};

/// T_a_b of two poses in one frame: the pose of b in the frame of a.
inline Pose2 between(const Pose2& T_w_a, const Pose2& T_w_b) { return T_w_a.inverse() * T_w_b; }

/// A step that is so many times as long, and turns as far.
inline Pose2 stretched(const Pose2& step, double scale) {
  return {scale * step.x_m(), scale * step.y_m(), step.yaw_rad()};
}

/// Derivative of T_a_b * T_b_c (as a vector) with respect to T_a_b (Smith, Self & Cheeseman 1990, J1 of the
/// compounding operator).
inline Eigen::Matrix3d jacobian_compose_first(const Pose2& T_a_b, const Pose2& T_b_c) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -T_a_b.sin_yaw() * T_b_c.x_m() - T_a_b.cos_yaw() * T_b_c.y_m();
  J(1, 2) = T_a_b.cos_yaw() * T_b_c.x_m() - T_a_b.sin_yaw() * T_b_c.y_m();
  return J;
}
/// Derivative of T_a_b * T_b_c with respect to T_b_c (J2 of the compounding operator).
inline Eigen::Matrix3d jacobian_compose_second(const Pose2& T_a_b) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 0) = T_a_b.cos_yaw();
  J(0, 1) = -T_a_b.sin_yaw();
  J(1, 0) = T_a_b.sin_yaw();
  J(1, 1) = T_a_b.cos_yaw();
  return J;
}
/// Derivative of T_a_b.inverse() with respect to T_a_b.
inline Eigen::Matrix3d jacobian_inverse(const Pose2& T_a_b) {
  const double c = T_a_b.cos_yaw();
  const double s = T_a_b.sin_yaw();
  Eigen::Matrix3d J;
  J << -c, -s, s * T_a_b.x_m() - c * T_a_b.y_m(),  //
      s, -c, c * T_a_b.x_m() + s * T_a_b.y_m(),    //
      0.0, 0.0, -1.0;
  return J;
}

}  // namespace swiftlet
