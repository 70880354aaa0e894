// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

// Definitions of the members of LandmarkGraphSolver; included by landmark_graph_solver.hpp alone.
#include <Eigen/LU>
#include <algorithm>

#include "core/frontend/landmark_graph_solver.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {

template <LandmarkGraphCapacity kCapacity>
auto LandmarkGraphSolver<kCapacity>::optimize(Graph& graph, int max_steps,
                                              const LandmarkGraphSolverTuning& tuning) -> Summary {
  group_by_landmark(graph);
  find_envelope(graph);
  Summary summary{0, graph.chi_square()};
  double damping = tuning.first_damping;
  while (summary.steps < max_steps && unknowns_ > 0) {
    ++summary.steps;
    save(graph);
    linearize(graph);
    const bool solved = solve(graph, damping);
    if (solved) apply(graph);
    const double after = solved ? graph.chi_square() : summary.chi_square;
    if (!solved || !(after <= summary.chi_square)) {
      restore(graph);
      damping *= tuning.damping_factor;
      continue;
    }
    const double decrease = summary.chi_square - after;
    summary.chi_square = after;
    damping /= tuning.damping_factor;
    if (decrease <= tuning.settled * (1e-3 + after)) break;
  }
  return summary;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::save(const Graph& graph) {
  for (std::size_t i = 0; i < graph.poses().size(); ++i) saved_poses_[i] = graph.poses()[i].T_local_body;
  for (std::size_t i = 0; i < graph.landmarks().size(); ++i)
    saved_lines_[i] = graph.landmarks()[i].line_local;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::restore(Graph& graph) const {
  for (std::size_t i = 0; i < graph.poses().size(); ++i) graph.poses()[i].T_local_body = saved_poses_[i];
  for (std::size_t i = 0; i < graph.landmarks().size(); ++i)
    graph.landmarks()[i].line_local = saved_lines_[i];
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::group_by_landmark(const Graph& graph) {
  const std::size_t landmarks = graph.landmarks().size();
  std::fill_n(group_begin_.begin(), landmarks + 1, 0);
  for (const LineObservation& seen : graph.observations()) ++group_begin_[seen.landmark + 1];
  for (std::size_t i = 0; i < landmarks; ++i) group_begin_[i + 1] += group_begin_[i];
  std::array<std::size_t, kCapacity.landmarks> next{};
  std::copy_n(group_begin_.begin(), landmarks, next.begin());
  for (std::size_t i = 0; i < graph.observations().size(); ++i)
    grouped_[next[graph.observations()[i].landmark]++] = i;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::find_envelope(const Graph& graph) {
  unknowns_ = 3 * (graph.poses().size() - 1);
  for (std::size_t pose = 1; pose < graph.poses().size(); ++pose)
    std::fill_n(first_column_.begin() + static_cast<std::ptrdiff_t>(row_of(pose)), 3,
                row_of(std::max<std::size_t>(pose - 1, 1)));
  for (std::size_t landmark = 0; landmark < graph.landmarks().size(); ++landmark) {
    std::size_t first_pose = 0;  // the first that may move; observations are in the order of poses
    for (const std::size_t index : seen_by(landmark)) {
      const std::size_t pose = graph.observations()[index].pose;
      if (pose == 0) continue;
      if (first_pose == 0) first_pose = pose;
      for (std::size_t k = 0; k < 3; ++k)
        first_column_[row_of(pose) + k] = std::min(first_column_[row_of(pose) + k], row_of(first_pose));
    }
  }
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::clear(const Graph& graph) {
  for (std::size_t i = 0; i < unknowns_; ++i)
    std::fill(H_.data() + i * kMaxUnknowns + first_column_[i], H_.data() + i * kMaxUnknowns + i + 1, 0.0);
  std::fill_n(g_.begin(), unknowns_, 0.0);
  for (std::size_t i = 0; i < graph.landmarks().size(); ++i) {
    const Landmark& landmark = graph.landmarks()[i];
    blocks_[i].H = landmark.prior.information;
    blocks_[i].g =
        -landmark.prior.information * line_difference(landmark.prior.mean_local, landmark.line_local);
  }
}

// Only what lies in the lower triangle is kept; the blocks of the diagonal are symmetric.
template <LandmarkGraphCapacity kCapacity>
template <typename Block>
void LandmarkGraphSolver<kCapacity>::add_block(std::size_t row, std::size_t column, const Block& block) {
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3 && column + c <= row + r; ++c)
      H_[(row + r) * kMaxUnknowns + column + c] +=
          block(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::linearize(const Graph& graph) {
  clear(graph);
  linearize_motions(graph);
  linearize_lines(graph);
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::linearize_motions(const Graph& graph) {
  const std::span<const PoseVertex> poses = graph.poses();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const PoseResidual motion =
        pose_residual(poses[i].T_previous_body, poses[i - 1].T_local_body, poses[i].T_local_body);
    const Eigen::Matrix3d weighted_to = poses[i].information * motion.J_to;
    const Eigen::Matrix3d weighted_from = poses[i].information * motion.J_from;
    const std::size_t to = row_of(i);
    add_block(to, to, motion.J_to.transpose() * weighted_to);
    Eigen::Map<Eigen::Vector3d>(g_.data() + to) += weighted_to.transpose() * motion.error;
    if (i == 1) continue;
    const std::size_t from = row_of(i - 1);
    add_block(to, from, motion.J_to.transpose() * weighted_from);
    add_block(from, from, motion.J_from.transpose() * weighted_from);
    Eigen::Map<Eigen::Vector3d>(g_.data() + from) += weighted_from.transpose() * motion.error;
  }
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::linearize_lines(const Graph& graph) {
  for (std::size_t i = 0; i < graph.observations().size(); ++i) {
    const LineObservation& seen = graph.observations()[i];
    const LineError line = line_error(seen.line_body, graph.poses()[seen.pose].T_local_body,
                                      graph.landmarks()[seen.landmark].line_local);
    const Eigen::Matrix2d weighted_line = seen.information * line.J_line;
    blocks_[seen.landmark].H += line.J_line.transpose() * weighted_line;
    blocks_[seen.landmark].g += weighted_line.transpose() * line.error;
    if (seen.pose == 0) continue;
    const std::size_t row = row_of(seen.pose);
    const Eigen::Matrix<double, 2, 3> weighted_pose = seen.information * line.J_pose;
    cross_[i] = line.J_pose.transpose() * weighted_line;
    add_block(row, row, line.J_pose.transpose() * weighted_pose);
    Eigen::Map<Eigen::Vector3d>(g_.data() + row) += weighted_pose.transpose() * line.error;
  }
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::damp(const Graph& graph, double damping) {
  for (std::size_t i = 0; i < unknowns_; ++i) H_[i * kMaxUnknowns + i] *= 1.0 + damping;
  for (std::size_t i = 0; i < graph.landmarks().size(); ++i) blocks_[i].H.diagonal() *= 1.0 + damping;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::eliminate_landmarks(const Graph& graph) {
  for (std::size_t landmark = 0; landmark < graph.landmarks().size(); ++landmark) {
    LandmarkBlock& block = blocks_[landmark];
    block.H_inverse = block.H.inverse();
    const std::span<const std::size_t> seen_by_poses = seen_by(landmark);
    for (std::size_t a = 0; a < seen_by_poses.size(); ++a) {
      const std::size_t pose_a = graph.observations()[seen_by_poses[a]].pose;
      if (pose_a == 0) continue;
      const Block3x2 scaled = cross_[seen_by_poses[a]] * block.H_inverse;
      Eigen::Map<Eigen::Vector3d>(g_.data() + row_of(pose_a)) -= scaled * block.g;
      for (std::size_t b = 0; b < seen_by_poses.size(); ++b) {
        const std::size_t pose_b = graph.observations()[seen_by_poses[b]].pose;
        if (pose_b == 0 || pose_b > pose_a) continue;
        add_block(row_of(pose_a), row_of(pose_b),
                  Eigen::Matrix3d(-scaled * cross_[seen_by_poses[b]].transpose()));
      }
    }
  }
}

template <LandmarkGraphCapacity kCapacity>
bool LandmarkGraphSolver<kCapacity>::solve(const Graph& graph, double damping) {
  damp(graph, damping);
  eliminate_landmarks(graph);
  const EnvelopeMatrix system{H_.data(), kMaxUnknowns, unknowns_, first_column_.data()};
  if (!factor_in_place(system)) return false;
  solve_in_place(system, std::span(g_.data(), unknowns_));
  for (std::size_t landmark = 0; landmark < graph.landmarks().size(); ++landmark) {
    Eigen::Vector2d right = blocks_[landmark].g;
    for (const std::size_t index : seen_by(landmark)) {
      const std::size_t pose = graph.observations()[index].pose;
      if (pose == 0) continue;
      right -= cross_[index].transpose() * Eigen::Map<const Eigen::Vector3d>(g_.data() + row_of(pose));
    }
    blocks_[landmark].step = blocks_[landmark].H_inverse * right;
  }
  return true;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraphSolver<kCapacity>::apply(Graph& graph) const {
  const std::span<PoseVertex> poses = graph.poses();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double* step = g_.data() + row_of(i);
    const Pose2& at = poses[i].T_local_body;
    poses[i].T_local_body = Pose2(at.x_m() - step[0], at.y_m() - step[1], at.yaw_rad() - step[2]);
  }
  const std::span<Landmark> landmarks = graph.landmarks();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    landmarks[i].line_local.rho_m -= blocks_[i].step(0);
    landmarks[i].line_local.alpha_rad = wrap_angle(landmarks[i].line_local.alpha_rad - blocks_[i].step(1));
    landmarks[i].covariance = blocks_[i].H_inverse;
  }
}

}  // namespace swiftlet
