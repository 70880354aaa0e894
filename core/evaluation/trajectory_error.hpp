// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>

#include "core/evaluation/stamped_path.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Distance of an estimated path from the true one after the best rigid alignment of the whole.
struct TrajectoryError {
  std::size_t pairs = 0;   ///< 0: nothing to compare, all else is 0
  double rmse_m = 0.0;     ///< the absolute trajectory error (ATE)
  double mean_m = 0.0;     ///< of the distances
  double max_m = 0.0;      ///< of the distances
  Pose2 T_truth_estimate;  ///< the alignment
};

/// J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, eq. (3), in the plane;
/// the alignment is S. Umeyama's closed form (PAMI 1991) without scale. The two lists are paired by position.
/// Precondition: same size.
[[nodiscard]] TrajectoryError trajectory_error(std::span<const Point2> estimate_m,
                                               std::span<const Point2> truth_m);

/// The same of two stamped paths: each estimated position is paired with StampedPath::position_at() of the
/// truth.
struct PathError {
  TrajectoryError position;
  StampMatching stamps;  ///< of the estimate, in the truth
};
[[nodiscard]] PathError path_error(const StampedPath& estimate, const StampedPath& truth);

}  // namespace swiftlet
