// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph_optimizer.hpp"

#include <utility>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kConvergedStep = 1e-5;  // metres or radians, largest component

double chi_square_of(const PoseConstraint& c, const std::vector<Pose2>& poses) {
  const PoseResidual r = pose_residual(c.T_from_to, poses[index_of(c.from)], poses[index_of(c.to)]);
  return r.error.dot(c.information * r.error);
}

double chi_square_of(const HeadingConstraint& c, const std::vector<Pose2>& poses) {
  const double error_rad = wrap_angle(poses[index_of(c.keyframe)].yaw_rad() - c.yaw_map_rad);
  return c.information * error_rad * error_rad;
}

}  // namespace

double PoseGraphOptimizer::scale(const PoseConstraint& constraint, double chi_square) const {
  return constraint.is_closure ? dcs_scale(chi_square, dcs_phi_) : 1.0;
}

/// What weights of s^2 minimise: their integral over chi-square.
double PoseGraphOptimizer::robust_cost(double chi_square) const {
  if (chi_square <= dcs_phi_) return chi_square;
  return dcs_phi_ * (3.0 * chi_square - dcs_phi_) / (dcs_phi_ + chi_square);
}

Result<OptimizeReport> PoseGraphOptimizer::optimize(PoseGraph& graph) {
  OptimizeReport report;
  if (graph.T_map_keyframe.size() < 2) return report;
  if (Status status = system_.prepare(graph.T_map_keyframe.size(), graph.constraints); !status)
    return status.error();
  std::vector<Pose2> poses = graph.T_map_keyframe;
  while (report.iterations < max_iterations_) {
    system_.set_zero();
    for (const PoseConstraint& c : graph.constraints) {
      const double s = scale(c, chi_square_of(c, poses));
      system_.add(c, s * s, poses);
    }
    for (const HeadingConstraint& c : graph.headings) {
      const double s = dcs_scale(chi_square_of(c, poses), dcs_phi_);
      system_.add(c, s * s, poses);
    }
    const Result<double> largest = system_.step(poses);
    if (!largest) return largest.error();
    ++report.iterations;
    if (*largest < kConvergedStep) break;
  }
  for (PoseConstraint& c : graph.constraints) {
    const double chi_square = chi_square_of(c, poses);
    c.dcs_scale = scale(c, chi_square);
    report.chi_square += c.is_closure ? robust_cost(chi_square) : chi_square;
  }
  for (HeadingConstraint& c : graph.headings) {
    const double chi_square = chi_square_of(c, poses);
    c.dcs_scale = dcs_scale(chi_square, dcs_phi_);
    report.chi_square += robust_cost(chi_square);
  }
  graph.T_map_keyframe = std::move(poses);
  return report;
}

}  // namespace swiftlet
