// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/joint_problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/backend/refinement/wall_patches.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, kSystematicErrors>;  // unknowns by errors
using Small = Eigen::Matrix<double, kSystematicErrors, kSystematicErrors>;
using MotionByErrors = Eigen::Matrix<double, 3, kSystematicErrors>;

constexpr double kHeldInformation = 1e12;  // of the first node

/// A gyro's heading does not go with travel, that of wheels not with time; to estimate both would only blur
/// them, since most of the time the vehicle goes at the same pace. Stamps that come in bunches show no age.
SystematicErrors prior_sigmas(bool yaw_goes_with_travel, bool shows_age, const JointProblemTuning& tuning) {
  constexpr double kNone = 1e-9;
  SystematicErrors sigma(tuning.prior_sigma.data());
  if (!shows_age) sigma(index_of(SystematicError::kRangeAge)) = kNone;
  sigma(index_of(yaw_goes_with_travel ? SystematicError::kYawPerSecond : SystematicError::kYawPerMetre)) =
      kNone;
  return sigma;
}

/// A return and the patch it lies on.
struct WallReturn {
  std::uint32_t scan = 0;
  std::uint32_t patch = 0;
  std::uint32_t sight = 0;
  Point2 p_body;
};

/// A patch as seen from a node.
struct Sight {
  std::uint32_t node = 0;
  std::uint32_t patch = 0;
};

struct PatchState {
  WallPatch at;
  double distance_m = 0.0;  // along the normal
  double turn_rad = 0.0;    // counter-clockwise
};

/// A pose in the frame of its node.
struct InNode {
  Pose2 T_node_body;
  MotionByErrors by_errors = MotionByErrors::Zero();
};

/// Consecutive scans whose dead reckoning, less its systematic errors, is taken as it is.
struct Node {
  std::size_t first = 0;  // scan, in whose body frame the node is
  Pose2 T_map_node;
  bool is_linked = true;        // to the node before, by dead reckoning
  InNode next;                  // the next node's first scan by dead reckoning
  Eigen::Vector2d variance_to;  // of the motion from the node before: of either coordinate, of yaw
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
  MotionByErrors by_errors;
};

class JointProblem {
 public:
  JointProblem(std::span<const CalibrationScan> scans, const SensorModel& sensor,
               std::span<const Pose2> T_map_body, const JointProblemTuning& tuning);

  /// Scales the standard deviations of dead reckoning's positions.
  void scale_position_noise(double scale) { position_noise_scale_ = scale; }
  void associate();
  Status step();
  void summarize(JointEstimate& estimate) const;
  [[nodiscard]] bool settled() const { return settled_; }
  [[nodiscard]] const SystematicErrors& errors() const { return errors_; }

 private:
  [[nodiscard]] Index row_of_node(std::size_t node) const { return static_cast<Index>(3 * node); }
  [[nodiscard]] Index row_of_patch(std::size_t patch) const {
    return static_cast<Index>(3 * nodes_.size() + 2 * patch);
  }
  [[nodiscard]] Index unknowns() const { return row_of_patch(patches_.size()); }
  void divide(std::span<const Pose2> T_map_body);
  void reckon();
  [[nodiscard]] WallRow wall_row(const WallReturn& wall) const;
  [[nodiscard]] MotionRow motion_row(std::size_t to) const;
  void measure_wall_sigma();
  void gather();
  void gather_patches(std::vector<Eigen::Triplet<double>>& H);
  void gather_walls(std::vector<Eigen::Triplet<double>>& H);
  void gather_motions(std::vector<Eigen::Triplet<double>>& H);
  void move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors);
  [[nodiscard]] Small scatter_of_stretches() const;

  JointProblemTuning tuning_;
  std::span<const CalibrationScan> scans_;
  OdometryNoise noise_;
  double min_wall_sigma_m_;
  SystematicMotion motion_;
  SystematicErrors prior_sigma_;
  double position_noise_scale_ = 1.0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> node_of_;  // of each scan
  std::vector<InNode> in_node_;         // each scan
  SystematicErrors errors_ = SystematicErrors::Zero();
  double wall_sigma_m_;
  std::vector<WallReturn> returns_;
  std::vector<Sight> sights_;
  std::vector<PatchState> patches_;

  // Normal equations of the last step, with the unknowns eliminated.
  Eigen::SimplicialLDLT<Sparse> solver_;
  bool analyzed_ = false;
  Sparse H_;
  Wide H_errors_;  // between unknowns and errors
  Small errors_information_ = Small::Zero();
  Eigen::VectorXd gradient_;
  SystematicErrors errors_gradient_ = SystematicErrors::Zero();
  Wide by_errors_;  // derivative of the unknowns with respect to the errors, negative
  Small reduced_ = Small::Identity();
  bool settled_ = false;
};

JointProblem::JointProblem(std::span<const CalibrationScan> scans, const SensorModel& sensor,
                           std::span<const Pose2> T_map_body, const JointProblemTuning& tuning)
    : tuning_(tuning),
      scans_(scans),
      noise_(sensor.odometry),
      min_wall_sigma_m_(sensor.range_sigma_m),
      motion_(odometry_of(scans), tuning.motion),
      prior_sigma_(prior_sigmas(yaw_goes_with_travel(sensor.odometry), motion_.shows_time_offset(), tuning)),
      node_of_(scans.size()),
      in_node_(scans.size()),
      wall_sigma_m_(tuning.first_wall_sigma_m) {
  divide(T_map_body);
  reckon();
}

/// Divides the path into nodes.
void JointProblem::divide(std::span<const Pose2> T_map_body) {
  double way_m = 0.0;
  double turn_rad = 0.0;
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const bool is_known = i > 0 && motion_.is_known(i);
    if (is_known) {
      const Pose2 step = motion_.measured(i);
      way_m += std::hypot(step.x_m(), step.y_m());
      turn_rad += std::abs(step.yaw_rad());
      const OdometrySigma sigma = odometry_sigma(noise_, step);
      variance += Eigen::Vector2d(sigma.xy_m * sigma.xy_m, sigma.yaw_rad * sigma.yaw_rad);
    }
    if (!is_known || way_m > tuning_.node_way_m || turn_rad > tuning_.node_turn_rad ||
        scans_[i].measured_at - scans_[nodes_.back().first].measured_at > tuning_.node_duration) {
      nodes_.push_back({i, T_map_body[i], is_known, {}, variance});
      way_m = turn_rad = 0.0;
      variance.setZero();
    }
    node_of_[i] = static_cast<std::uint32_t>(nodes_.size() - 1);
  }
}

/// Places the scans in their nodes, and the nodes to each other, by dead reckoning less the present errors.
void JointProblem::reckon() {
  const std::span<const CorrectedStep> steps = motion_.correct(errors_);
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    const bool is_first = node_of_[i] != node_of_[i - 1];
    if (is_first && !nodes_[node_of_[i]].is_linked) continue;
    const InNode& before = in_node_[i - 1];
    InNode& here = is_first ? nodes_[node_of_[i - 1]].next : in_node_[i];
    const Pose2& step = steps[i].T_previous_this;
    here.T_node_body = before.T_node_body * step;
    here.by_errors = jacobian_compose_first(before.T_node_body, step) * before.by_errors +
                     jacobian_compose_second(before.T_node_body) * steps[i].by_errors;
  }
}

void JointProblem::associate() {
  std::vector<DrawnReturn> drawn;
  std::vector<WallReturn> all;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Pose2 T = nodes_[node_of_[i]].T_map_node * in_node_[i].T_node_body;
    for (const Point2& p_body : scans_[i].hits_body) {
      const Point2 p = T * p_body;
      const double range_m = std::hypot(p_body.x_m, p_body.y_m);
      drawn.push_back({p, {(p.x_m - T.x_m()) / range_m, (p.y_m - T.y_m()) / range_m}});
      all.push_back({static_cast<std::uint32_t>(i), WallPatches::kNone, 0, p_body});
    }
  }
  const WallPatches found = find_wall_patches(drawn, tuning_.patches);
  returns_.clear();
  sights_.clear();
  patches_.clear();
  for (const WallPatch& patch : found.patches) patches_.push_back({patch, 0.0, 0.0});
  std::vector<std::uint32_t> last_sight(patches_.size(), WallPatches::kNone);  // of each patch
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (found.patch_of[k] == WallPatches::kNone) continue;
    const Point2 normal = found.patches[found.patch_of[k]].normal_map;
    const Point2 beam = drawn[k].direction_map;
    if (-normal.x_m * beam.x_m - normal.y_m * beam.y_m < tuning_.min_incidence_cosine) continue;
    all[k].patch = found.patch_of[k];
    std::uint32_t& sight = last_sight[all[k].patch];
    const std::uint32_t node = node_of_[all[k].scan];
    if (sight == WallPatches::kNone || sights_[sight].node != node) {
      sight = static_cast<std::uint32_t>(sights_.size());
      sights_.push_back({node, all[k].patch});
    }
    all[k].sight = sight;
    returns_.push_back(all[k]);
  }
  analyzed_ = false;
}

WallRow JointProblem::wall_row(const WallReturn& wall) const {
  const InNode& scan = in_node_[wall.scan];
  const Pose2& T = nodes_[node_of_[wall.scan]].T_map_node;
  const PatchState& patch = patches_[wall.patch];
  // A turn is small; a patch's direction needs no more than its first order.
  const Point2& n = patch.at.normal_map;
  const Point2 normal{n.x_m - patch.turn_rad * n.y_m, n.y_m + patch.turn_rad * n.x_m};
  const Point2 p_node = scan.T_node_body * wall.p_body;
  const Point2 p = T * p_node;
  const Point2 off{p.x_m - patch.at.center_map.x_m, p.y_m - patch.at.center_map.y_m};
  WallRow row;
  row.error = normal.x_m * off.x_m + normal.y_m * off.y_m - patch.distance_m;
  row.by_node << normal.x_m, normal.y_m, -normal.x_m * (p.y_m - T.y_m()) + normal.y_m * (p.x_m - T.x_m());
  row.by_patch << -1.0, -n.y_m * off.x_m + n.x_m * off.y_m;
  const Point2 normal_node{T.cos_yaw() * normal.x_m + T.sin_yaw() * normal.y_m,
                           -T.sin_yaw() * normal.x_m + T.cos_yaw() * normal.y_m};
  const double by_yaw = -normal_node.x_m * (p_node.y_m - scan.T_node_body.y_m()) +
                        normal_node.y_m * (p_node.x_m - scan.T_node_body.x_m());
  row.by_errors = scan.by_errors.transpose() * Eigen::Vector3d(normal_node.x_m, normal_node.y_m, by_yaw);
  const double scaled = row.error / (tuning_.robust_sigmas * wall_sigma_m_);
  const double robust = 1.0 / ((1.0 + scaled * scaled) * (1.0 + scaled * scaled));  // Geman-McClure
  row.weight = robust / (wall_sigma_m_ * wall_sigma_m_);
  return row;
}

/// The next node as it is, in the frame in which dead reckoning predicts it.
MotionRow JointProblem::motion_row(std::size_t to) const {
  const Node& from = nodes_[to - 1];
  const Node& next = nodes_[to];
  const Pose2 T_from_map = from.T_map_node.inverse();
  const Pose2 moved = T_from_map * next.T_map_node;
  const Pose2 predicted = next.is_linked ? from.next.T_node_body : moved;
  const Pose2 T_predicted_from = predicted.inverse();
  const Eigen::Matrix3d by_moved = jacobian_compose_second(T_predicted_from);
  MotionRow row;
  row.error = (T_predicted_from * moved).vector();
  row.by_from =
      by_moved * jacobian_compose_first(T_from_map, next.T_map_node) * jacobian_inverse(from.T_map_node);
  row.by_to = by_moved * jacobian_compose_second(T_from_map);
  row.by_errors = MotionByErrors::Zero();
  row.weight = kUnknownMotion.information();
  if (!next.is_linked) return row;
  row.by_errors =
      jacobian_compose_first(T_predicted_from, moved) * jacobian_inverse(predicted) * from.next.by_errors;
  const double scale = position_noise_scale_ * position_noise_scale_;
  row.weight << 1.0 / (scale * next.variance_to(0)), 1.0 / (scale * next.variance_to(0)),
      1.0 / next.variance_to(1);
  return row;
}

void JointProblem::measure_wall_sigma() {
  if (returns_.empty()) return;
  std::vector<double> off;
  off.reserve(returns_.size());
  for (const WallReturn& wall : returns_) off.push_back(std::abs(wall_row(wall).error));
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  wall_sigma_m_ = std::max(min_wall_sigma_m_, 1.4826 * *middle);
}

template <int kRows, int kColumns>
void put(std::vector<Eigen::Triplet<double>>& H, Index row, Index column,
         const Eigen::Matrix<double, kRows, kColumns>& block) {
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c)
      if (row + r >= column + c) H.emplace_back(row + r, column + c, block(r, c));
}

void JointProblem::gather_patches(std::vector<Eigen::Triplet<double>>& H) {
  const double by_distance = 1.0 / (tuning_.patch_distance_sigma_m * tuning_.patch_distance_sigma_m);
  const double by_turn = 1.0 / (tuning_.patch_turn_sigma_rad * tuning_.patch_turn_sigma_rad);
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    const Index at = row_of_patch(m);
    H.emplace_back(at, at, by_distance);
    H.emplace_back(at + 1, at + 1, by_turn);
    gradient_(at) += by_distance * patches_[m].distance_m;
    gradient_(at + 1) += by_turn * patches_[m].turn_rad;
  }
}

void JointProblem::gather_walls(std::vector<Eigen::Triplet<double>>& H) {
  using Five = Eigen::Matrix<double, 5, 1>;
  std::vector<Eigen::Matrix<double, 5, 5>> by_sight(sights_.size(), Eigen::Matrix<double, 5, 5>::Zero());
  for (const WallReturn& wall : returns_) {
    const WallRow row = wall_row(wall);
    Five both;
    both << row.by_node, row.by_patch;
    const Five weighted = row.weight * both;
    by_sight[wall.sight].noalias() += weighted * both.transpose();
    const Index node = row_of_node(node_of_[wall.scan]);
    const Index patch = row_of_patch(wall.patch);
    gradient_.segment<3>(node) += row.error * weighted.head<3>();
    gradient_.segment<2>(patch) += row.error * weighted.tail<2>();
    H_errors_.middleRows<3>(node).noalias() += weighted.head<3>() * row.by_errors.transpose();
    H_errors_.middleRows<2>(patch).noalias() += weighted.tail<2>() * row.by_errors.transpose();
    errors_information_.noalias() += row.weight * row.by_errors * row.by_errors.transpose();
    errors_gradient_ += row.weight * row.error * row.by_errors;
  }
  for (std::size_t k = 0; k < sights_.size(); ++k) {
    const Index node = row_of_node(sights_[k].node);
    const Index patch = row_of_patch(sights_[k].patch);
    put<3, 3>(H, node, node, by_sight[k].topLeftCorner<3, 3>());
    put<2, 2>(H, patch, patch, by_sight[k].bottomRightCorner<2, 2>());
    put<2, 3>(H, patch, node, by_sight[k].bottomLeftCorner<2, 3>());
  }
}

void JointProblem::gather_motions(std::vector<Eigen::Triplet<double>>& H) {
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const MotionRow row = motion_row(i);
    const Index from = row_of_node(i - 1);
    const Index to = row_of_node(i);
    const Eigen::Matrix3d A = row.by_from.transpose() * row.weight.asDiagonal();
    const Eigen::Matrix3d B = row.by_to.transpose() * row.weight.asDiagonal();
    put<3, 3>(H, from, from, A * row.by_from);
    put<3, 3>(H, to, to, B * row.by_to);
    put<3, 3>(H, to, from, B * row.by_from);
    gradient_.segment<3>(from) += A * row.error;
    gradient_.segment<3>(to) += B * row.error;
    H_errors_.middleRows<3>(from) += A * row.by_errors;
    H_errors_.middleRows<3>(to) += B * row.by_errors;
    const Eigen::Matrix<double, kSystematicErrors, 3> C = row.by_errors.transpose() * row.weight.asDiagonal();
    errors_information_ += C * row.by_errors;
    errors_gradient_ += C * row.error;
  }
}

void JointProblem::gather() {
  const Index n = unknowns();
  std::vector<Eigen::Triplet<double>> H;
  H.reserve(sights_.size() * 15 + nodes_.size() * 21 + patches_.size() * 2 + 3);
  gradient_ = Eigen::VectorXd::Zero(n);
  H_errors_ = Wide::Zero(n, static_cast<Index>(kSystematicErrors));
  const SystematicErrors information = prior_sigma_.array().square().inverse();
  errors_information_ = information.asDiagonal();
  errors_gradient_ = information.cwiseProduct(errors_);
  for (Index k = 0; k < 3; ++k) H.emplace_back(k, k, kHeldInformation);
  gather_patches(H);
  gather_walls(H);
  gather_motions(H);
  H_.resize(n, n);
  H_.setFromTriplets(H.begin(), H.end());
}

void JointProblem::move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3d moved = nodes_[i].T_map_node.vector() + unknowns.segment<3>(row_of_node(i));
    nodes_[i].T_map_node = Pose2(moved(0), moved(1), moved(2));
  }
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    const auto d = unknowns.segment<2>(row_of_patch(m));
    patches_[m].distance_m += d(0);
    patches_[m].turn_rad += d(1);
  }
  errors_ += errors;
  reckon();
}

Status JointProblem::step() {
  measure_wall_sigma();
  gather();
  if (!analyzed_) solver_.analyzePattern(H_);
  analyzed_ = true;
  solver_.factorize(H_);
  if (solver_.info() != Eigen::Success)
    return Error{ErrorCode::kSolver,
                 "the joint problem of poses, walls and systematic errors has no solution"};
  by_errors_ = solver_.solve(H_errors_);
  const Eigen::VectorXd settled = solver_.solve(gradient_);
  reduced_ = errors_information_ - H_errors_.transpose() * by_errors_;
  const SystematicErrors change = -reduced_.ldlt().solve(errors_gradient_ - H_errors_.transpose() * settled);
  const Eigen::VectorXd unknowns = -settled - by_errors_ * change;
  if (!unknowns.allFinite() || !change.allFinite())
    return Error{ErrorCode::kSolver, "the joint problem of poses, walls and systematic errors diverged"};
  move(unknowns, change);
  const SystematicErrors sigma = reduced_.inverse().diagonal().cwiseSqrt();
  settled_ = (change.array().abs() < tuning_.settled * sigma.array()).all();
  return {};
}

/// Sum of squares of the gradients of single stretches of time, with the other unknowns eliminated.
Small JointProblem::scatter_of_stretches() const {
  const auto stretch_of = [&](std::size_t scan) {
    return static_cast<std::size_t>((scans_[scan].measured_at - scans_.front().measured_at) /
                                    tuning_.stretch);
  };
  std::vector<SystematicErrors> gradients(stretch_of(scans_.size() - 1) + 1, SystematicErrors::Zero());
  for (const WallReturn& wall : returns_) {
    const WallRow row = wall_row(wall);
    const SystematicErrors by_errors =
        row.by_errors - by_errors_.middleRows<3>(row_of_node(node_of_[wall.scan])).transpose() * row.by_node -
        by_errors_.middleRows<2>(row_of_patch(wall.patch)).transpose() * row.by_patch;
    gradients[stretch_of(wall.scan)] += row.weight * row.error * by_errors;
  }
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const MotionRow row = motion_row(i);
    const MotionByErrors by_errors = row.by_errors -
                                     row.by_from * by_errors_.middleRows<3>(row_of_node(i - 1)) -
                                     row.by_to * by_errors_.middleRows<3>(row_of_node(i));
    gradients[stretch_of(nodes_[i].first)] += by_errors.transpose() * row.weight.cwiseProduct(row.error);
  }
  Small scatter = Small::Zero();
  for (const SystematicErrors& g : gradients) scatter += g * g.transpose();
  return scatter;
}

void JointProblem::summarize(JointEstimate& estimate) const {
  const Small by_model = reduced_.inverse();
  const Small by_scatter = by_model * scatter_of_stretches() * by_model;
  estimate.errors = errors_;
  estimate.sigma = by_model.diagonal().cwiseMax(by_scatter.diagonal()).cwiseSqrt();
  const auto age = index_of(SystematicError::kRangeAge);
  if (!motion_.shows_time_offset()) estimate.sigma(age) = tuning_.prior_sigma[static_cast<std::size_t>(age)];
  estimate.patches = patches_.size();
  estimate.returns_on_them = returns_.size();
  estimate.wall_sigma_m = wall_sigma_m_;
}

/// Where the motion is hardly larger than its noise, the estimate depends on the noise model, and scatter
/// does not show that: adds the change of the estimate when the noise is half or twice as large.
Status add_noise_uncertainty(const JointProblemTuning& tuning, JointProblem& problem,
                             JointEstimate& estimate) {
  SystematicErrors furthest = SystematicErrors::Zero();
  for (const double scale : {1.0 / tuning.noise_factor, tuning.noise_factor}) {
    problem.scale_position_noise(scale);
    for (int step = 0; step < tuning.steps_per_noise; ++step)
      if (Status status = problem.step(); !status) return status;
    furthest = furthest.cwiseMax((problem.errors() - estimate.errors).cwiseAbs());
  }
  estimate.sigma = (estimate.sigma.array().square() + furthest.array().square()).sqrt();
  return {};
}

/// Poses and walls converge together, slowest where the errors are hardly observable: adds the change of the
/// estimate in the second half of the associations.
void add_convergence_uncertainty(const SystematicErrors& halfway, JointEstimate& estimate) {
  const SystematicErrors moved = estimate.errors - halfway;
  estimate.sigma = (estimate.sigma.array().square() + moved.array().square()).sqrt();
}

/// Dead reckoning is a chord between its samples, which limits the accuracy of a time offset; scatter does
/// not show that.
void add_sampling_uncertainty(double sampling_s, JointEstimate& estimate) {
  double& sigma_s = estimate.sigma(index_of(SystematicError::kRangeAge));
  sigma_s = std::hypot(sigma_s, sampling_s);
}

}  // namespace

Result<JointEstimate> estimate_jointly(std::span<const CalibrationScan> scans, const SensorModel& sensor,
                                       std::span<const Pose2> T_map_body, const GoOn& go_on,
                                       const JointProblemTuning& tuning) {
  SWIFTLET_CHECK(scans.size() >= 2 && T_map_body.size() == scans.size(), "every scan has a pose");
  JointProblem problem(scans, sensor, T_map_body, tuning);
  SystematicErrors halfway = SystematicErrors::Zero();
  for (int round = 0; round < tuning.associations; ++round) {
    if (round == tuning.associations / 2) halfway = problem.errors();
    problem.associate();
    for (int step = 0; step < tuning.steps_per_association; ++step) {
      if (!go_on((round + static_cast<double>(step) / tuning.steps_per_association) / tuning.associations))
        return Error{ErrorCode::kTimeout, "stopped"};
      if (Status status = problem.step(); !status) return status.error();
      if (problem.settled()) break;
    }
  }
  JointEstimate estimate;
  problem.summarize(estimate);
  if (Status status = add_noise_uncertainty(tuning, problem, estimate); !status) return status.error();
  add_convergence_uncertainty(halfway, estimate);
  add_sampling_uncertainty(tuning.sampling_share * usual_interval_s(odometry_of(scans)), estimate);
  return estimate;
}

}  // namespace swiftlet
