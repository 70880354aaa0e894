// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {
namespace {

std::vector<BlockSystem3::BlockIndex> pattern_of(std::span<const PosePair> pairs) {
  std::vector<BlockSystem3::BlockIndex> pattern;
  for (const PosePair& pair : pairs) {
    const std::uint32_t low = std::min(index_of(pair.from), index_of(pair.to));
    const std::uint32_t high = std::max(index_of(pair.from), index_of(pair.to));
    if (low > 0) pattern.push_back({high - 1, low - 1});
  }
  return pattern;
}

bool same(const std::vector<BlockSystem3::BlockIndex>& a, const std::vector<BlockSystem3::BlockIndex>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return p.row == q.row && p.column == q.column; });
}

}  // namespace

Result<double> move_poses(std::span<const double> steps, std::vector<Pose2>& T_map_pose) {
  double largest = 0.0;
  for (const double component : steps) {
    if (!std::isfinite(component))
      return Error{ErrorCode::kSolver, "pose graph diverged: poses are no longer finite"};
    largest = std::max(largest, std::abs(component));
  }
  for (std::size_t b = 0; b + 1 < T_map_pose.size(); ++b) {
    const double* d = steps.data() + 3 * b;
    Pose2& T = T_map_pose[b + 1];
    T = Pose2(T.x_m() + d[0], T.y_m() + d[1], T.yaw_rad() + d[2]);
  }
  return largest;
}

Status PoseSystem::prepare(std::size_t pose_count, std::span<const RelativePoseFactor<PoseIndex>> factors) {
  std::vector<PosePair> pairs;
  pairs.reserve(factors.size());
  for (const RelativePoseFactor<PoseIndex>& f : factors) pairs.push_back({f.from, f.to});
  return prepare_pairs(pose_count, pairs);
}

Status PoseSystem::prepare_pairs(std::size_t pose_count, std::span<const PosePair> pairs) {
  SWIFTLET_CHECK(pose_count >= 2, "there is a pose to move");
  std::vector<BlockSystem3::BlockIndex> pattern = pattern_of(pairs);
  if (analyzed_poses_ == pose_count && same(pattern, analyzed_pattern_)) return {};
  analyzed_poses_ = 0;
  system_ = BlockSystem3(pose_count - 1, pattern, kFirstFree);
  if (Status status = solver_.analyze(system_); !status) return status;
  analyzed_pattern_ = std::move(pattern);
  analyzed_poses_ = pose_count;
  return {};
}

void PoseSystem::add(const RelativePoseFactor<PoseIndex>& factor, double weight,
                     const std::vector<Pose2>& T_map_pose) {
  const PoseResidual r =
      pose_residual(factor.T_from_to, T_map_pose[index_of(factor.from)], T_map_pose[index_of(factor.to)]);
  const Eigen::Matrix3d W = weight * factor.information;
  const Eigen::Matrix3d A = r.J_from.transpose() * W;
  const Eigen::Matrix3d B = r.J_to.transpose() * W;
  add(factor.from, A * r.J_from, -A * r.error);
  add(factor.to, B * r.J_to, -B * r.error);
  add(factor.to, factor.from, B * r.J_from);
}

void PoseSystem::add(const HeadingFactor<PoseIndex>& factor, double weight,
                     const std::vector<Pose2>& T_map_pose) {
  const double w = weight * factor.information;
  const double error_rad = wrap_angle(T_map_pose[index_of(factor.pose)].yaw_rad() - factor.yaw_map_rad);
  add(factor.pose, Eigen::Vector3d(0.0, 0.0, w).asDiagonal(), Eigen::Vector3d(0.0, 0.0, -w * error_rad));
}

void PoseSystem::add(PoseIndex pose, const Eigen::Matrix3d& H, const Eigen::Vector3d& rhs) {
  if (pose == PoseIndex{}) return;
  const std::uint32_t block = index_of(pose) - 1;
  system_.add(block, block, H.data());
  for (std::uint32_t k = 0; k < 3; ++k) system_.rhs[3 * block + k] += rhs[static_cast<Eigen::Index>(k)];
}

void PoseSystem::add(PoseIndex a, PoseIndex b, const Eigen::Matrix3d& H_ab) {
  const std::uint32_t i = index_of(a);
  const std::uint32_t j = index_of(b);
  if (i == 0 || j == 0) return;
  const Eigen::Matrix3d H = i > j ? H_ab : Eigen::Matrix3d(H_ab.transpose());
  system_.add(std::max(i, j) - 1, std::min(i, j) - 1, H.data());
}

Result<double> PoseSystem::step(std::vector<Pose2>& T_map_pose) {
  const Result<std::vector<double>> solution = solver_.solve(system_);
  if (!solution) return solution.error();
  return move_poses(*solution, T_map_pose);
}

}  // namespace swiftlet
