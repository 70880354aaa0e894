// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/LU>

#include "core/backend/backend.hpp"

namespace swiftlet {

/// How far a closure is from the truth, in units of the uncertainty it claims: chi-square of three degrees of
/// freedom.
inline double chi_square_against(const LoopClosure& closure, const Pose2& T_from_to_truth) {
  Eigen::Vector3d error = closure.T_from_to.vector() - T_from_to_truth.vector();
  error[2] = wrap_angle(error[2]);
  return error.dot(closure.covariance.matrix().inverse() * error);
}

}  // namespace swiftlet
