// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Absolute trajectory error: root mean square distance of the positions after the rigid motion that fits
/// them best (Umeyama 1991, without scale; in the plane a complex mean). Both have one pose per scan.
inline double aligned_rms_error_m(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  const auto position = [](const Pose2& pose) { return std::complex<double>(pose.x_m(), pose.y_m()); };
  const auto count = static_cast<double>(truth.size());
  std::complex<double> mean_estimate;
  std::complex<double> mean_truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    mean_estimate += position(estimate[i]) / count;
    mean_truth += position(truth[i]) / count;
  }
  std::complex<double> correlation;
  for (std::size_t i = 0; i < truth.size(); ++i)
    correlation += std::conj(position(estimate[i]) - mean_estimate) * (position(truth[i]) - mean_truth);
  const std::complex<double> turn = std::polar(1.0, std::arg(correlation));
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum_m2 += std::norm(turn * (position(estimate[i]) - mean_estimate) - (position(truth[i]) - mean_truth));
  return std::sqrt(sum_m2 / count);
}

}  // namespace swiftlet
