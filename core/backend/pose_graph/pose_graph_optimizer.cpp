// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
double PoseGraphOptimizer::scale(const PoseConstraint& constraint, double chi_square) const {
  return constraint.is_closure ? dcs_scale(chi_square, dcs_phi_) : 1.0;
}

/// What weights of s^2 minimise: their integral over chi-square.
double PoseGraphOptimizer::robust_cost(double chi_square) const {
  if (chi_square <= dcs_phi_) return chi_square;
  return dcs_phi_ * (3.0 * chi_square - dcs_phi_) / (dcs_phi_ + chi_square);
}

Result<OptimizeReport> PoseGraphOptimizer::optimize(PoseGraph& graph, const OptimizeEffort& effort) {
  OptimizeReport report;
  if (graph.T_map_keyframe.size() < 2) return report;
  if (Status status = system_.prepare(graph.T_map_keyframe.size(), graph.constraints); !status)
    return status.error();
  std::vector<Pose2> poses = graph.T_map_keyframe;
  const int most = std::min(max_iterations_, effort.max_iterations);
  while (report.iterations < most) {
    system_.set_zero();
    for (const PoseConstraint& c : graph.constraints) {
      const double s = scale(c, chi_square(c, poses));
      system_.add(c, s * s, poses);
    }
    for (const HeadingConstraint& c : graph.headings) {
      const double s = dcs_scale(chi_square(c, poses), dcs_phi_);
      system_.add(c, s * s, poses);
    }
    const Result<double> largest = system_.step(poses);
    if (!largest) return largest.error();
    ++report.iterations;
    report.converged = *largest < effort.converged_step;
    if (report.converged) break;
  }
  for (PoseConstraint& c : graph.constraints) {
    const double error = chi_square(c, poses);
    c.dcs_scale = scale(c, error);
    report.chi_square += c.is_closure ? robust_cost(error) : error;
  }
  for (HeadingConstraint& c : graph.headings) {
    const double error = chi_square(c, poses);
    c.dcs_scale = dcs_scale(error, dcs_phi_);
    report.chi_square += robust_cost(error);
  }
  graph.T_map_keyframe = std::move(poses);
  return report;
}

}  // namespace swiftlet
