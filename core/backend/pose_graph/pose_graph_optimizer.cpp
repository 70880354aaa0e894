// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"

#include <algorithm>
#include <vector>

namespace swiftlet {
namespace {

/// The graph as a solver sees it.
struct DenseGraph {
  explicit DenseGraph(const PoseGraph& graph)
      : T_map_pose(graph.T_map_keyframe.values().begin(), graph.T_map_keyframe.values().end()) {
    factors.reserve(graph.factors.size());
    for (const RelativePoseFactor<KeyframeId>& f : graph.factors.values())
      factors.push_back(f.joining(graph.pose_index(f.from), graph.pose_index(f.to)));
    for (const HeadingFactor<KeyframeId>& f : graph.headings)
      headings.push_back(f.of(graph.pose_index(f.pose)));
  }
  std::vector<Pose2> T_map_pose;
  std::vector<RelativePoseFactor<PoseIndex>> factors;
  std::vector<HeadingFactor<PoseIndex>> headings;
};

}  // namespace

Result<OptimizeReport> PoseGraphOptimizer::optimize(PoseGraph& graph, const OptimizeEffort& effort) {
  OptimizeReport report;
  if (graph.T_map_keyframe.size() < 2) return report;
  DenseGraph dense(graph);
  std::vector<Pose2>& poses = dense.T_map_pose;
  if (Status status = system_.prepare(poses.size(), dense.factors); !status) return status.error();
  const int most = std::min(max_iterations_, effort.max_iterations);
  while (report.iterations < most) {
    system_.set_zero();
    for (const RelativePoseFactor<PoseIndex>& f : dense.factors) {
      const double s = f.is_closure ? dcs_scale(chi_square(f, poses), dcs_phi_) : 1.0;
      system_.add(f, s * s, poses);
    }
    for (const HeadingFactor<PoseIndex>& f : dense.headings) {
      const double s = dcs_scale(chi_square(f, poses), dcs_phi_);
      system_.add(f, s * s, poses);
    }
    const Result<double> largest = system_.step(poses);
    if (!largest) return largest.error();
    ++report.iterations;
    report.converged = *largest < effort.converged_step;
    if (report.converged) break;
  }
  for (std::size_t i = 0; i < dense.factors.size(); ++i) {
    const RelativePoseFactor<PoseIndex>& f = dense.factors[i];
    const double error = chi_square(f, poses);
    graph.factors.values()[i].dcs_scale = f.is_closure ? dcs_scale(error, dcs_phi_) : 1.0;
    report.chi_square += f.is_closure ? dcs_cost(error, dcs_phi_) : error;
  }
  for (std::size_t i = 0; i < dense.headings.size(); ++i) {
    const double error = chi_square(dense.headings[i], poses);
    graph.headings[i].dcs_scale = dcs_scale(error, dcs_phi_);
    report.chi_square += dcs_cost(error, dcs_phi_);
  }
  std::copy(poses.begin(), poses.end(), graph.T_map_keyframe.values().begin());
  return report;
}

}  // namespace swiftlet
