// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_chain.hpp"

#include <Eigen/Cholesky>
#include <string>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {

void PoseChain::reset(std::size_t pose_count) {
  SWIFTLET_CHECK(pose_count >= 2, "there is a pose to move");
  links_.assign(pose_count - 1, {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
}

void PoseChain::add(const RelativePoseFactor<PoseIndex>& step, const std::vector<Pose2>& T_map_pose) {
  SWIFTLET_CHECK(step.to == step.from + 1, "a chain's factors join neighbours");
  const std::uint32_t from = index_of(step.from);
  const PoseResidual r = pose_residual(step.T_from_to, T_map_pose[from], T_map_pose[from + 1]);
  const Eigen::Matrix3d A = r.J_from.transpose() * step.information;
  const Eigen::Matrix3d B = r.J_to.transpose() * step.information;
  add(step.from, A * r.J_from, -A * r.error);
  add(step.to, B * r.J_to, -B * r.error);
  links_[from].H_before += B * r.J_from;
}

void PoseChain::add(PoseIndex pose, const Eigen::Matrix3d& H, const Eigen::Vector3d& rhs) {
  if (pose == PoseIndex{}) return;
  Link& link = links_[index_of(pose) - 1];
  link.H += H;
  link.rhs += rhs;
}

/// Block elimination; each link then holds the inverse of what is left of its block.
Status PoseChain::step(std::vector<Pose2>& T_map_pose) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& link = links_[i];
    if (i > 0) {
      const Link& before = links_[i - 1];
      const Eigen::Matrix3d K = link.H_before * before.H;
      link.H -= K * link.H_before.transpose();
      link.rhs -= K * before.rhs;
    }
    const Eigen::LLT<Eigen::Matrix3d> cholesky(link.H);
    if (cholesky.info() != Eigen::Success)
      return Error{ErrorCode::kSolver, "chain of poses underconstrained near pose " + std::to_string(i + 1) +
                                           ": its constraints leave a direction open"};
    link.H = cholesky.solve(Eigen::Matrix3d::Identity());
  }
  std::vector<double> steps(3 * links_.size());
  Eigen::Vector3d after = Eigen::Vector3d::Zero();
  for (std::size_t i = links_.size(); i-- > 0;) {
    Link& link = links_[i];
    if (i + 1 < links_.size()) link.rhs -= links_[i + 1].H_before.transpose() * after;
    after = link.H * link.rhs;
    Eigen::Vector3d::Map(&steps[3 * i]) = after;
  }
  if (const Result<double> largest = move_poses(steps, T_map_pose); !largest) return largest.error();
  return {};
}

}  // namespace swiftlet
