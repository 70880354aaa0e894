// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Whether two poses agree within a distance and an angle; prints both poses where not.
inline testing::AssertionResult poses_near(const Pose2& actual, const Pose2& expected, double tolerance_m,
                                           double tolerance_rad) {
  const double off_m = std::hypot(actual.x_m() - expected.x_m(), actual.y_m() - expected.y_m());
  const double off_rad = std::abs(wrap_angle(actual.yaw_rad() - expected.yaw_rad()));
  if (off_m <= tolerance_m && off_rad <= tolerance_rad) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "(" << actual.vector().transpose() << ") lies " << off_m << " m and "
                                     << off_rad << " rad from (" << expected.vector().transpose() << ")";
}

inline bool same_bits(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (std::bit_cast<std::uint64_t>(a[i].vector()[k]) != std::bit_cast<std::uint64_t>(b[i].vector()[k]))
        return false;
  return a.size() == b.size();
}

}  // namespace swiftlet
