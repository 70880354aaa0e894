// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/refinement/floor_field.hpp"
#include "core/backend/refinement/node_patch_matrix.hpp"
#include "core/backend/refinement/rigid_nodes.hpp"
#include "core/backend/refinement/wall_patches.hpp"
#include "core/base/result.hpp"
#include "core/sensing/systematic_motion.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {

/// A return of a scan, both of one problem.
struct ScanHit {
  std::uint32_t scan = 0;
  StoreyId storey{};
  Point2 p_body;
};

/// What is known of poses beside walls and dead reckoning. Poses are scans.
struct PoseKnowledge {
  std::vector<RelativePoseFactor<PoseIndex>> closures;
  std::vector<HeadingFactor<PoseIndex>> headings;
  double closure_weight = 1.0;  ///< on information
};

/// One least-squares problem over all unknowns together: the path as RigidNodes, distance and direction of
/// each wall patch, and the systematic errors. The factors join returns with patches (robust), neighbouring
/// nodes by dead reckoning less its systematic errors, and what else is known of poses. So a motion that
/// walls and ranges do not determine adds no false information. The first node is held.
///
/// Allocates. Repeatable. One thread at a time.
class PosesAndWalls {
 public:
  struct Tuning {
    PosesAndWallsTuning walls;
    WallFitTuning fit;
    WallPatchesTuning patches;
  };
  using ErrorsMatrix = Eigen::Matrix<double, kSystematicErrors, kSystematicErrors>;

  /// `hits`: by scan. `T_map_body`: one pose per scan, close enough that traversals over one wall lie within
  /// a decimetre. `prior`: covariance of the errors; 0 for those that are none. `min_wall_sigma_m`: a return
  /// scatters no less around its wall.
  PosesAndWalls(RigidNodes nodes, std::vector<ScanHit> hits, PoseKnowledge known,
                std::span<const Pose2> T_map_body, const SystematicCovariance& prior, double min_wall_sigma_m,
                const Tuning& tuning);

  /// Finds the patches anew, at the present poses.
  void associate();
  /// The same with patches that were found otherwise, of the returns as drawn() has them.
  void associate_with(const WallPatches& found);
  /// One Gauss-Newton step over all unknowns. Errors: kSolver; all is then as it was.
  Status step();
  /// From the next associate() on, what the floor does to dead reckoning is unknown, too.
  void let_floor_vary(const FloorFieldTuning& tuning) { floor_.emplace(tuning); }
  /// Scales the standard deviations of dead reckoning's positions.
  void scale_position_noise(double scale) { position_noise_scale_ = scale; }

  [[nodiscard]] const RigidNodes& nodes() const { return nodes_; }
  [[nodiscard]] std::span<const ScanHit> hits() const { return hits_; }
  /// The hits at the present poses. Allocates.
  [[nodiscard]] std::vector<DrawnReturn> drawn() const;
  [[nodiscard]] std::span<const Pose2> T_map_node() const { return T_map_node_; }
  [[nodiscard]] const SystematicErrors& errors() const { return errors_; }
  [[nodiscard]] const std::optional<FloorField>& floor() const { return floor_; }
  [[nodiscard]] std::size_t patches() const { return patches_.size(); }
  [[nodiscard]] std::size_t returns_on_patches() const { return returns_.size(); }
  /// Robust scatter of the returns around their patches.
  [[nodiscard]] double wall_sigma_m() const { return wall_sigma_m_; }

  // Of the last step:
  /// Of the errors, the other unknowns being left free.
  [[nodiscard]] const ErrorsMatrix& information() const { return reduced_; }
  [[nodiscard]] const SystematicErrors& change() const { return change_; }
  /// Sum over groups of scans of the squares of the errors' gradients, the other unknowns being left free.
  /// `group_of_scan` ascends from 0.
  [[nodiscard]] ErrorsMatrix scatter(std::span<const std::size_t> group_of_scan) const;

 private:
  using Index = Eigen::Index;
  using Sight = NodePatchMatrix::Sight;
  using Solver =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>>;
  using Wide = Eigen::Matrix<double, Eigen::Dynamic, kSystematicErrors>;  // unknowns by errors

  /// A return and the patch that it lies on.
  struct WallReturn {
    std::uint32_t hit = 0;
    std::uint32_t patch = 0;
    std::uint32_t sight = 0;
  };
  struct PatchState {
    WallPatch at;
    double distance_m = 0.0;  // along the normal
    double turn_rad = 0.0;    // counter-clockwise
  };
  /// A linearised wall residual: distance of a return from its patch.
  struct WallRow {
    double error = 0.0;
    double weight = 0.0;
    Eigen::Vector3d by_node;
    Eigen::Vector2d by_patch;
    SystematicErrors by_errors;
  };
  /// A linearised residual of dead reckoning from one node to the next.
  struct MotionRow {
    Eigen::Vector3d error;
    Eigen::Vector3d weight;  // information, diagonal
    Eigen::Matrix3d by_from;
    Eigen::Matrix3d by_to;
    Eigen::Matrix<double, 3, kSystematicErrors> by_errors;
    Eigen::Vector3d by_floor = Eigen::Vector3d::Zero();
  };
  /// A cell of the floor under the motion to a node, as seen from either end.
  struct FloorSights {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
  };

  [[nodiscard]] Pose2 T_map_scan(std::size_t scan) const {
    return T_map_node_[nodes_.node_of(scan)] * nodes_.in_node(scan).T_node_body;
  }
  [[nodiscard]] WallRow wall_row(const WallReturn& wall) const;
  [[nodiscard]] MotionRow motion_row(std::size_t to) const;
  void forget_equations();
  [[nodiscard]] WallPatches find_patches(std::span<const DrawnReturn> drawn) const;
  void take(const WallPatches& found, std::span<const DrawnReturn> drawn);
  void find_sights(const WallPatches& found, std::span<const DrawnReturn> drawn);
  void find_floor_sights();
  [[nodiscard]] NodePatchMatrix matrix() const;
  void measure_wall_sigma();
  void gather();
  void gather_patches();
  void gather_walls();
  void gather_motions();
  void gather_floor(std::size_t to, const MotionRow& row);
  void gather_floor_prior();
  void gather_known();
  void move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors);

  Tuning tuning_;
  RigidNodes nodes_;
  std::vector<ScanHit> hits_;
  PoseKnowledge known_;
  ErrorsMatrix prior_information_;
  std::array<bool, kSystematicErrors> is_error_{};
  double min_wall_sigma_m_;
  double wall_sigma_m_;
  double position_noise_scale_ = 1.0;
  std::vector<Pose2> T_map_node_;
  SystematicErrors errors_ = SystematicErrors::Zero();
  std::vector<WallReturn> returns_;
  std::vector<Sight> sights_;
  std::vector<PatchState> patches_;
  std::optional<FloorField> floor_;        // its cells follow the patches as further ones of one unknown
  std::vector<FloorSights> floor_sights_;  // by node

  // Normal equations of the last step, with the unknowns eliminated.
  std::optional<NodePatchMatrix> H_;
  std::optional<Solver> solver_;
  Wide H_errors_;  // between unknowns and errors
  ErrorsMatrix errors_information_ = ErrorsMatrix::Zero();
  Eigen::VectorXd gradient_;
  SystematicErrors errors_gradient_ = SystematicErrors::Zero();
  Wide by_errors_;  // derivative of the unknowns with respect to the errors, negative
  ErrorsMatrix reduced_ = ErrorsMatrix::Identity();
  SystematicErrors change_ = SystematicErrors::Zero();
};

}  // namespace swiftlet
