// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <random>

#include "core/geometry/line2.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet::test {

/// Seeded poses, points and lines within a few metres of the origin.
class RandomGeometry {
 public:
  explicit RandomGeometry(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(generator_); }
  Pose2 pose() { return {uniform(-5.0, 5.0), uniform(-5.0, 5.0), uniform(-kPi, kPi)}; }
  Point2 point() { return {uniform(-5.0, 5.0), uniform(-5.0, 5.0)}; }
  /// At least 0.2 m from the origin.
  Line2 line() { return {uniform(0.2, 5.0), uniform(-kPi, kPi)}; }

 private:
  std::mt19937 generator_;
};

inline Pose2 pose_of(const Eigen::Vector3d& v) { return {v(0), v(1), v(2)}; }

}  // namespace swiftlet::test
