// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "core/frontend/envelope_cholesky.hpp"
#include "core/frontend/landmark_graph.hpp"

namespace swiftlet {

/// Minimises F(X) of eq. (9) by Levenberg-Marquardt. Each landmark is eliminated on its own in a 2x2 block
/// (Schur complement); the remaining system over the poses is factored in place within its envelope. The
/// oldest pose is fixed.
/// @note Fixed storage. One thread at a time.
template <LandmarkGraphCapacity kCapacity>
class LandmarkGraphSolver {
 public:
  using Graph = LandmarkGraph<kCapacity>;

  struct Summary {
    int steps = 0;            ///< tried
    double chi_square = 0.0;  ///< reached
  };

  /// At most `max_steps`, fewer when F converges. F never increases.
  Summary optimize(Graph& graph, int max_steps, const LandmarkGraphSolverTuning& tuning = {});

 private:
  static constexpr std::size_t kMaxUnknowns = 3 * kCapacity.poses;
  using Block3x2 = Eigen::Matrix<double, 3, 2>;

  // A landmark's part of the normal equations H dx = -g.
  struct LandmarkBlock {
    Eigen::Matrix2d H;
    Eigen::Matrix2d H_inverse;  // damped
    Eigen::Vector2d g;
    Eigen::Vector2d step;
  };

  void save(const Graph& graph);
  void restore(Graph& graph) const;
  void clear(const Graph& graph);
  void group_by_landmark(const Graph& graph);
  void find_envelope(const Graph& graph);
  void linearize(const Graph& graph);
  void linearize_motions(const Graph& graph);
  void linearize_lines(const Graph& graph);
  void damp(const Graph& graph, double damping);
  void eliminate_landmarks(const Graph& graph);
  [[nodiscard]] bool solve(const Graph& graph, double damping);
  void apply(Graph& graph) const;

  [[nodiscard]] std::span<const std::size_t> seen_by(std::size_t landmark) const {
    return {grouped_.data() + group_begin_[landmark], group_begin_[landmark + 1] - group_begin_[landmark]};
  }
  // Pose 0 is the gauge and has no row.
  static std::size_t row_of(std::size_t pose) { return 3 * (pose - 1); }
  template <typename Block>
  void add_block(std::size_t row, std::size_t column, const Block& block);

  std::array<double, kMaxUnknowns * kMaxUnknowns> H_{};  // lower triangle, then its factor
  std::array<std::size_t, kMaxUnknowns> first_column_{};
  std::array<double, kMaxUnknowns> g_{};  // then the step
  std::size_t unknowns_ = 0;
  std::array<LandmarkBlock, kCapacity.landmarks> blocks_;
  std::array<Block3x2, kCapacity.observations> cross_;         // pose-landmark block of each observation
  std::array<std::size_t, kCapacity.observations> grouped_{};  // observations, landmark by landmark
  std::array<std::size_t, kCapacity.landmarks + 1> group_begin_{};
  std::array<Pose2, kCapacity.poses> saved_poses_;
  std::array<Line2, kCapacity.landmarks> saved_lines_;
};

}  // namespace swiftlet

#include "core/frontend/landmark_graph_solver_impl.hpp"
