// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/geometry/squared.hpp"

namespace swiftlet {

/// Weight of a residual r under the robust kernel of Geman & McClure (1985), from r² / scale²: 1 where it is
/// 0, a quarter where it is 1. Iterated least squares with it minimise the sum of geman_mcclure_cost().
[[nodiscard]] inline double geman_mcclure_weight(double scaled_residual2) {
  return 1.0 / squared(1.0 + scaled_residual2);
}

/// In units of scale²: the residual's square where it is small, at most 1.
[[nodiscard]] inline double geman_mcclure_cost(double scaled_residual2) {
  return scaled_residual2 / (1.0 + scaled_residual2);
}

}  // namespace swiftlet
