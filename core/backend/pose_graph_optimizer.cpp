// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet {
namespace {

constexpr double kConvergedStep = 1e-5;  // metres or radians, largest component

/// The first pose is the gauge: block b of the system is pose b + 1.
std::vector<BlockSystem3::BlockIndex> pattern_of(const PoseGraph& graph) {
  std::vector<BlockSystem3::BlockIndex> pattern;
  for (const PoseConstraint& c : graph.constraints) {
    const std::uint32_t low = std::min(index_of(c.from), index_of(c.to));
    const std::uint32_t high = std::max(index_of(c.from), index_of(c.to));
    if (low > 0) pattern.push_back({high - 1, low - 1});
  }
  return pattern;
}

bool same(const std::vector<BlockSystem3::BlockIndex>& a, const std::vector<BlockSystem3::BlockIndex>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return p.row == q.row && p.column == q.column; });
}

void add_to_rhs(BlockSystem3& system, std::uint32_t block, const Eigen::Vector3d& v) {
  for (std::uint32_t i = 0; i < 3; ++i) system.rhs[3 * block + i] += v[i];
}

/// One constraint's share of H dx = -g. Returns its robust cost.
double linearize(PoseConstraint& c, const std::vector<Pose2>& poses, double dcs_phi, BlockSystem3& system) {
  const PoseResidual r = pose_residual(c.T_from_to, poses[index_of(c.from)], poses[index_of(c.to)]);
  const double chi_square = r.error.dot(c.information * r.error);
  if (c.is_closure) c.dcs_scale = dcs_scale(chi_square, dcs_phi);
  const double weight = c.dcs_scale * c.dcs_scale;
  const Eigen::Matrix3d W = weight * c.information;
  const Eigen::Matrix3d A = r.J_from.transpose() * W;
  const Eigen::Matrix3d B = r.J_to.transpose() * W;
  const std::uint32_t i = index_of(c.from);
  const std::uint32_t j = index_of(c.to);
  if (i > 0) {
    const Eigen::Matrix3d H = A * r.J_from;
    system.add(i - 1, i - 1, H.data());
    add_to_rhs(system, i - 1, -A * r.error);
  }
  if (j > 0) {
    const Eigen::Matrix3d H = B * r.J_to;
    system.add(j - 1, j - 1, H.data());
    add_to_rhs(system, j - 1, -B * r.error);
  }
  if (i > 0 && j > 0) {
    const Eigen::Matrix3d H = j > i ? Eigen::Matrix3d(B * r.J_from) : Eigen::Matrix3d(A * r.J_to);
    system.add(std::max(i, j) - 1, std::min(i, j) - 1, H.data());
  }
  // DCS as a cost: s^2 chi^2 + phi (1 - s)^2.
  return weight * chi_square + (c.is_closure ? dcs_phi * (1.0 - c.dcs_scale) * (1.0 - c.dcs_scale) : 0.0);
}

}  // namespace

Result<OptimizeReport> PoseGraphOptimizer::optimize(PoseGraph& graph) {
  OptimizeReport report;
  if (graph.T_map_keyframe.size() < 2) return report;
  std::vector<BlockSystem3::BlockIndex> pattern = pattern_of(graph);
  BlockSystem3 system(graph.T_map_keyframe.size() - 1, pattern);
  if (analyzed_poses_ != graph.T_map_keyframe.size() || !same(pattern, analyzed_pattern_)) {
    analyzed_poses_ = 0;
    if (Status status = solver_.analyze(system); !status) return status.error();
    analyzed_pattern_ = std::move(pattern);
    analyzed_poses_ = graph.T_map_keyframe.size();
  }
  std::vector<Pose2> poses = graph.T_map_keyframe;
  for (report.iterations = 0; report.iterations < max_iterations_;) {
    system.set_zero();
    report.chi_square = 0.0;
    for (PoseConstraint& c : graph.constraints) report.chi_square += linearize(c, poses, dcs_phi_, system);
    Result<std::vector<double>> step = solver_.solve(system);
    if (!step) return step.error();
    ++report.iterations;
    double largest = 0.0;
    for (std::size_t b = 0; b + 1 < poses.size(); ++b) {
      const double* d = step->data() + 3 * b;
      poses[b + 1] =
          Pose2(poses[b + 1].x_m() + d[0], poses[b + 1].y_m() + d[1], poses[b + 1].yaw_rad() + d[2]);
      largest = std::max({largest, std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    }
    if (!std::isfinite(largest))
      return Error{ErrorCode::kSolver, "pose graph diverged: poses are no longer finite"};
    if (largest < kConvergedStep) break;
  }
  graph.T_map_keyframe = std::move(poses);
  return report;
}

}  // namespace swiftlet
