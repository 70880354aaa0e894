// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/joint_problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/calibration/wall_patches.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, kSystematicErrors>;  // unknowns by errors
using Small = Eigen::Matrix<double, kSystematicErrors, kSystematicErrors>;
using MotionByErrors = Eigen::Matrix<double, 3, kSystematicErrors>;

constexpr double kHeldInformation = 1e12;  // of the first pose
constexpr double kNudge = 1e-4;            // of a difference quotient

/// A gyro's heading does not go with travel, that of wheels not with time; to estimate both would only blur
/// them, since most of the time the vehicle goes at the same pace.
SystematicErrors prior_sigmas(bool yaw_goes_with_travel, const JointProblemTuning& tuning) {
  constexpr double kNone = 1e-9;
  SystematicErrors sigma(tuning.prior_sigma.data());
  sigma(index_of(yaw_goes_with_travel ? SystematicError::kYawPerSecond : SystematicError::kYawPerMetre)) =
      kNone;
  return sigma;
}

/// A return and the patch it lies on.
struct WallReturn {
  std::uint32_t scan = 0;
  std::uint32_t patch = 0;
  Point2 p_body;
};

struct PatchState {
  WallPatch at;
  double distance_m = 0.0;  // along the normal
  double turn_rad = 0.0;    // counter-clockwise
};

/// A linearised wall residual: distance of a return from its patch.
struct WallRow {
  Index pose = 0;   // first unknown
  Index patch = 0;  // first unknown
  double error = 0.0;
  double weight = 0.0;
  Eigen::Vector3d by_pose;
  Eigen::Vector2d by_patch;
};

/// A linearised residual of dead reckoning; the unknowns of `from` end where those of `to` begin.
struct MotionRow {
  Index from = 0;
  Eigen::Vector3d error;
  Eigen::Vector3d weight;  // information, diagonal
  Eigen::Matrix3d by_from;
  Eigen::Matrix3d by_to;
  MotionByErrors by_errors;
};

class JointProblem {
 public:
  JointProblem(std::span<const CalibrationScan> scans, const SensorModel& sensor,
               std::vector<Pose2>& T_map_body, const JointProblemTuning& tuning)
      : tuning_(tuning),
        scans_(scans),
        noise_(sensor.odometry),
        min_wall_sigma_m_(sensor.range_sigma_m),
        prior_sigma_(prior_sigmas(yaw_goes_with_travel(sensor.odometry), tuning)),
        T_(T_map_body),
        motion_(scans, tuning.motion),
        wall_sigma_m_(tuning.first_wall_sigma_m) {}

  /// Scales the standard deviations of dead reckoning's positions.
  void scale_position_noise(double scale) { position_noise_scale_ = scale; }
  void associate();
  Status step();
  void summarize(JointEstimate& estimate) const;
  [[nodiscard]] bool settled() const { return settled_; }
  [[nodiscard]] const SystematicErrors& errors() const { return errors_; }

 private:
  [[nodiscard]] Index unknowns() const { return static_cast<Index>(3 * T_.size() + 2 * patches_.size()); }
  [[nodiscard]] WallRow wall_row(const WallReturn& wall) const;
  [[nodiscard]] MotionRow motion_row(std::size_t i) const;
  void measure_wall_sigma();
  void gather();
  void gather_walls(std::vector<Eigen::Triplet<double>>& H);
  void gather_motions(std::vector<Eigen::Triplet<double>>& H);
  void move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors);
  [[nodiscard]] Small scatter_of_stretches() const;

  JointProblemTuning tuning_;
  std::span<const CalibrationScan> scans_;
  OdometryNoise noise_;
  double min_wall_sigma_m_;
  SystematicErrors prior_sigma_;
  double position_noise_scale_ = 1.0;
  std::vector<Pose2>& T_;
  SystematicMotion motion_;
  SystematicErrors errors_ = SystematicErrors::Zero();
  double wall_sigma_m_;
  std::vector<WallReturn> returns_;
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

void JointProblem::associate() {
  std::vector<DrawnReturn> drawn;
  std::vector<WallReturn> all;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    for (const Point2& p_body : scans_[i].hits_body) {
      const Point2 p = T_[i] * p_body;
      const double range_m = std::hypot(p_body.x_m, p_body.y_m);
      drawn.push_back({p, {(p.x_m - T_[i].x_m()) / range_m, (p.y_m - T_[i].y_m()) / range_m}});
      all.push_back({static_cast<std::uint32_t>(i), WallPatches::kNone, p_body});
    }
  }
  const WallPatches found = find_wall_patches(drawn, tuning_.patches);
  returns_.clear();
  patches_.clear();
  for (const WallPatch& patch : found.patches) patches_.push_back({patch, 0.0, 0.0});
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (found.patch_of[k] == WallPatches::kNone) continue;
    const Point2 normal = found.patches[found.patch_of[k]].normal_map;
    const Point2 beam = drawn[k].direction_map;
    if (-normal.x_m * beam.x_m - normal.y_m * beam.y_m < tuning_.min_incidence_cosine) continue;
    all[k].patch = found.patch_of[k];
    returns_.push_back(all[k]);
  }
  analyzed_ = false;
}

WallRow JointProblem::wall_row(const WallReturn& wall) const {
  const Pose2& T = T_[wall.scan];
  const PatchState& patch = patches_[wall.patch];
  const Pose2 turn(0.0, 0.0, patch.turn_rad);
  const Point2 normal = turn * patch.at.normal_map;
  const Point2 p = T * wall.p_body;
  const Point2 off{p.x_m - patch.at.center_map.x_m, p.y_m - patch.at.center_map.y_m};
  WallRow row;
  row.pose = 3 * static_cast<Index>(wall.scan);
  row.patch = static_cast<Index>(3 * T_.size()) + 2 * static_cast<Index>(wall.patch);
  row.error = normal.x_m * off.x_m + normal.y_m * off.y_m - patch.distance_m;
  row.by_pose << normal.x_m, normal.y_m, -normal.x_m * (p.y_m - T.y_m()) + normal.y_m * (p.x_m - T.x_m());
  row.by_patch << -1.0, -normal.y_m * off.x_m + normal.x_m * off.y_m;
  const double scaled = row.error / (tuning_.robust_sigmas * wall_sigma_m_);
  const double robust = 1.0 / ((1.0 + scaled * scaled) * (1.0 + scaled * scaled));  // Geman-McClure
  row.weight = robust / (wall_sigma_m_ * wall_sigma_m_);
  return row;
}

/// Predicted less measured, with derivatives. The measured motion has the noise, so the scales act on the
/// true one: acting on the measured motion they would shrink it to shrink its noise.
MotionRow JointProblem::motion_row(std::size_t i) const {
  MotionRow row;
  row.from = static_cast<Index>(3 * (i - 1));
  const Pose2 T_from_map = T_[i - 1].inverse();
  const Pose2 moved = T_from_map * T_[i];
  const auto predicted = [&](const Eigen::Vector3d& m, const SystematicErrors& errors) {
    return motion_.predicted(i, Pose2(m(0), m(1), m(2)), errors).vector();
  };
  row.error = predicted(moved.vector(), errors_) - motion_.measured(i).vector();
  row.error(2) = wrap_angle(row.error(2));
  Eigen::Matrix3d by_motion;
  for (Index k = 0; k < 3; ++k) {
    const Eigen::Vector3d nudge = kNudge * Eigen::Vector3d::Unit(k);
    by_motion.col(k) =
        (predicted(moved.vector() + nudge, errors_) - predicted(moved.vector() - nudge, errors_)) /
        (2.0 * kNudge);
  }
  for (Index k = 0; k < row.by_errors.cols(); ++k) {
    const SystematicErrors nudge = kNudge * SystematicErrors::Unit(k);
    row.by_errors.col(k) =
        (predicted(moved.vector(), errors_ + nudge) - predicted(moved.vector(), errors_ - nudge)) /
        (2.0 * kNudge);
  }
  row.by_from = by_motion * jacobian_compose_first(T_from_map, T_[i]) * jacobian_inverse(T_[i - 1]);
  row.by_to = by_motion * jacobian_compose_second(T_from_map);
  row.weight =
      motion_.is_known(i) ? odometry_sigma(noise_, moved).information() : kUnknownMotion.information();
  row.weight.head<2>() /= position_noise_scale_ * position_noise_scale_;
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

void JointProblem::gather_walls(std::vector<Eigen::Triplet<double>>& H) {
  for (const WallReturn& wall : returns_) {
    const WallRow row = wall_row(wall);
    put<3, 3>(H, row.pose, row.pose, row.weight * row.by_pose * row.by_pose.transpose());
    put<2, 2>(H, row.patch, row.patch, row.weight * row.by_patch * row.by_patch.transpose());
    put<2, 3>(H, row.patch, row.pose, row.weight * row.by_patch * row.by_pose.transpose());
    gradient_.segment<3>(row.pose) += row.weight * row.error * row.by_pose;
    gradient_.segment<2>(row.patch) += row.weight * row.error * row.by_patch;
  }
}

void JointProblem::gather_motions(std::vector<Eigen::Triplet<double>>& H) {
  for (std::size_t i = 1; i < T_.size(); ++i) {
    const MotionRow row = motion_row(i);
    const Index to = row.from + 3;
    const Eigen::Matrix3d A = row.by_from.transpose() * row.weight.asDiagonal();
    const Eigen::Matrix3d B = row.by_to.transpose() * row.weight.asDiagonal();
    put<3, 3>(H, row.from, row.from, A * row.by_from);
    put<3, 3>(H, to, to, B * row.by_to);
    put<3, 3>(H, to, row.from, B * row.by_from);
    gradient_.segment<3>(row.from) += A * row.error;
    gradient_.segment<3>(to) += B * row.error;
    H_errors_.middleRows<3>(row.from) += A * row.by_errors;
    H_errors_.middleRows<3>(to) += B * row.by_errors;
    const Eigen::Matrix<double, kSystematicErrors, 3> C = row.by_errors.transpose() * row.weight.asDiagonal();
    errors_information_ += C * row.by_errors;
    errors_gradient_ += C * row.error;
  }
}

void JointProblem::gather() {
  const Index n = unknowns();
  std::vector<Eigen::Triplet<double>> H;
  H.reserve(returns_.size() * 15 + T_.size() * 21);
  gradient_ = Eigen::VectorXd::Zero(n);
  H_errors_ = Wide::Zero(n, static_cast<Index>(kSystematicErrors));
  const SystematicErrors information = prior_sigma_.array().square().inverse();
  errors_information_ = information.asDiagonal();
  errors_gradient_ = information.cwiseProduct(errors_);
  for (Index k = 0; k < 3; ++k) H.emplace_back(k, k, kHeldInformation);
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    const auto at = static_cast<Index>(3 * T_.size() + 2 * m);
    const double by_distance = 1.0 / (tuning_.patch_distance_sigma_m * tuning_.patch_distance_sigma_m);
    const double by_turn = 1.0 / (tuning_.patch_turn_sigma_rad * tuning_.patch_turn_sigma_rad);
    H.emplace_back(at, at, by_distance);
    H.emplace_back(at + 1, at + 1, by_turn);
    gradient_(at) += by_distance * patches_[m].distance_m;
    gradient_(at + 1) += by_turn * patches_[m].turn_rad;
  }
  gather_walls(H);
  gather_motions(H);
  H_.resize(n, n);
  H_.setFromTriplets(H.begin(), H.end());
}

void JointProblem::move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors) {
  for (std::size_t i = 0; i < T_.size(); ++i) {
    const auto d = unknowns.segment<3>(static_cast<Index>(3 * i));
    T_[i] = Pose2(T_[i].x_m() + d(0), T_[i].y_m() + d(1), T_[i].yaw_rad() + d(2));
  }
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    const auto d = unknowns.segment<2>(static_cast<Index>(3 * T_.size() + 2 * m));
    patches_[m].distance_m += d(0);
    patches_[m].turn_rad += d(1);
  }
  errors_ += errors;
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
    const SystematicErrors by_errors = -by_errors_.middleRows<3>(row.pose).transpose() * row.by_pose -
                                       by_errors_.middleRows<2>(row.patch).transpose() * row.by_patch;
    gradients[stretch_of(wall.scan)] += row.weight * row.error * by_errors;
  }
  for (std::size_t i = 1; i < T_.size(); ++i) {
    const MotionRow row = motion_row(i);
    const MotionByErrors by_errors = row.by_errors - row.by_from * by_errors_.middleRows<3>(row.from) -
                                     row.by_to * by_errors_.middleRows<3>(row.from + 3);
    gradients[stretch_of(i)] += by_errors.transpose() * row.weight.cwiseProduct(row.error);
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
    for (int step = 0; step < tuning.steps_per_association; ++step)
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
                                       std::vector<Pose2>& T_map_body, const GoOn& go_on,
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
  add_sampling_uncertainty(tuning.sampling_share * usual_interval_s(scans), estimate);
  return estimate;
}

}  // namespace swiftlet
