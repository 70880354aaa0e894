// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <limits>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/pose_graph/pose_system.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

struct OptimizeReport {
  int iterations = 0;
  bool converged = true;    ///< false: the effort allowed no more iterations
  double chi_square = 0.0;  ///< robust objective at the end
};

/// How far a solution is taken: until no step is larger than this (metres or radians, largest component), in
/// no more iterations than these and the optimizer's own.
struct OptimizeEffort {
  double converged_step = KeyframeGraphTuning().final_step;
  int max_iterations = std::numeric_limits<int>::max();
};

/// Minimises eq. 23 by Gauss-Newton with DCS on closures and headings. Allocates. One thread at a time.
class PoseGraphOptimizer {
 public:
  PoseGraphOptimizer(double dcs_phi, int max_iterations)
      : dcs_phi_(dcs_phi), max_iterations_(max_iterations) {}

  /// Moves the poses and writes each closure's and heading's dcs_scale. On kSolver the graph is as it was.
  Result<OptimizeReport> optimize(PoseGraph& graph, const OptimizeEffort& effort = {});

 private:
  double dcs_phi_;
  int max_iterations_;
  PoseSystem system_;
};

}  // namespace swiftlet
