// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

namespace swiftlet {

/// How well the frontend's lines of known walls fit, over about the last ten keyframes that saw any (5 m of
/// travel): chi-square per degree of freedom, 1 on average where noise is as assumed. Allocates nothing.
class RecentInnovation {
 public:
  void add(double chi_square, std::uint32_t degrees_of_freedom) {
    if (degrees_of_freedom == 0) return;
    constexpr double kKeyframes = 10.0;
    chi_square_ += (chi_square - chi_square_) / kKeyframes;
    degrees_ += (degrees_of_freedom - degrees_) / kKeyframes;
  }
  /// 0 before the first.
  [[nodiscard]] double per_degree() const { return degrees_ > 0.0 ? chi_square_ / degrees_ : 0.0; }

 private:
  double chi_square_ = 0.0;
  double degrees_ = 0.0;
};

}  // namespace swiftlet
