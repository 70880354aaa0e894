// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>

namespace swiftlet {

/// Inverse chi-square CDF at one confidence for whole degrees of freedom (eq. 19), tabulated when constructed
/// so that a lookup is cheap and throws nothing.
class ChiSquareTable {
 public:
  static constexpr std::size_t kMaxDegrees = 512;

  /// Precondition: 0 < confidence < 1.
  explicit ChiSquareTable(double confidence);
  /// 0 for 0 degrees of freedom. Beyond kMaxDegrees by the Wilson-Hilferty approximation.
  [[nodiscard]] double quantile(std::size_t degrees_of_freedom) const;

 private:
  std::array<double, kMaxDegrees + 1> quantile_{};
  double normal_quantile_;
};

}  // namespace swiftlet
