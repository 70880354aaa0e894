// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/window_refinement.hpp"

#include <utility>

#include "core/backend/store/traversal.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {

/// `first_pose`: of the window's first scan.
void WindowRefinement::take_returns(const ScanRange& window, std::size_t first_pose) {
  const std::size_t every = thinned_by(scans_->return_count(window), tuning_.max_window_returns, tuning_);
  problem_.clear();
  const std::span<const StoredScan> scans = scans_->all().values(window);
  const std::size_t first = scans_->all().position(window.first);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const ScanId id = scans_->all().id_at(first + i);
    for (const ScanReturn& beam : scans_->returns(scans[i])) {
      if (!beam.is_hit || (i + beam.beam) % every != 0) continue;
      problem_.add({make_id<PoseIndex>(first_pose + i), index_of(traversal_of(scans[i])), scans[i].storey,
                    is_held_out(id, beam.beam, tuning_), scans_->point_body(beam)});
    }
  }
}

void WindowRefinement::take_steps(const WindowPoses& poses) {
  steps_.clear();
  const std::span<const StoredScan> scans = scans_->all().values(poses.scans);
  for (std::size_t to = 1; to < scans.size(); ++to) {
    RelativePoseFactor<PoseIndex> step;
    step.from = make_id<PoseIndex>(to - 1);
    step.to = make_id<PoseIndex>(to);
    step.T_from_to = between(poses.T_local_body[to - 1], poses.T_local_body[to]);
    step.information = tuning_.step_weight * motion_information(scans[to - 1], scans[to], noise_);
    steps_.push_back(step);
  }
  weaken_doubted(poses.doubted, *scans_, poses.scans, steps_);
}

void WindowRefinement::add_ties(const WindowPoses& poses) {
  const Eigen::Matrix3d information =
      Eigen::Vector3d(tuning_.tie_sigma_m, tuning_.tie_sigma_m, tuning_.tie_sigma_rad)
          .cwiseAbs2()
          .cwiseInverse()
          .asDiagonal();
  const std::span<const StoredScan> scans = scans_->all().values(poses.scans);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (scans[i].keyframe == scans[i - 1].keyframe) continue;
    const PoseResidual r = pose_residual(Pose2(), poses.T_map_graph[i], poses.T_map_body[i]);
    const Eigen::Matrix3d A = r.J_to.transpose() * information;
    chain_.add(make_id<PoseIndex>(i), A * r.J_to, -A * r.error);
  }
}

Result<WindowReport> WindowRefinement::refine(const ScanRange& window, std::span<const TraversalPoint> others,
                                              WindowPoses& poses) {
  WindowReport report;
  if (poses.T_map_body.size() < 2) return report;
  take_returns(window, scans_->all().count({poses.scans.first, window.first}));
  take_steps(poses);
  std::vector<TraversalPoint> others_thinned;
  append_thinned(others, tuning_.thinning_cell_m, others_thinned);
  const StoreyId storey = scans_->all().values(window).front().storey;
  const auto walls_at = [&](const std::vector<Pose2>& T_map_body) {
    return problem_.walls_at(T_map_body, tuning_.walls.radius_m, others_thinned, storey);
  };
  const WallsByStorey before = walls_at(poses.T_map_body);
  report.returns = problem_.size();
  report.points = before.size();
  chain_.reset(poses.T_map_body.size());
  problem_.add_factors(before, poses.T_map_body, chain_);
  for (const RelativePoseFactor<PoseIndex>& step : steps_) chain_.add(step, poses.T_map_body);
  add_ties(poses);
  std::vector<Pose2> T = poses.T_map_body;
  if (const Status moved = chain_.step(T); !moved) return moved.error();
  report.judge(problem_.held_out_error_m(before, poses.T_map_body),
               problem_.held_out_error_m(walls_at(T), T));
  if (report.accepted) poses.T_map_body = std::move(T);
  return report;
}

}  // namespace swiftlet
