// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/joint_refinement.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/refinement/wall_patches.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/systematic_motion.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {
namespace {

using Factor = RelativePoseFactor<PoseIndex>;

/// A return and the patch it lies on, both by their place in the list of poses: a patch is the pose of its
/// centre, its x axis along the normal.
struct WallReturn {
  PoseIndex scan{};
  PoseIndex patch{};
  Point2 p_body;
};

/// Distance of a return from its patch along the normal, with its derivatives.
struct WallResidual {
  double error_m = 0.0;
  Eigen::Vector3d by_scan;
  Eigen::Vector3d by_patch;
};

WallResidual wall_residual(const Pose2& T_map_body, const Pose2& T_map_patch, const Point2& p_body) {
  const Point2 p = T_map_body * p_body;
  const Point2 off{p.x_m - T_map_patch.x_m(), p.y_m - T_map_patch.y_m()};
  const double nx = T_map_patch.cos_yaw();
  const double ny = T_map_patch.sin_yaw();
  const Point2 lever{p.x_m - T_map_body.x_m(), p.y_m - T_map_body.y_m()};
  return {nx * off.x_m + ny * off.y_m,
          {nx, ny, ny * lever.x_m - nx * lever.y_m},
          {-nx, -ny, nx * off.y_m - ny * off.x_m}};
}

constexpr double kWallSigmasOfReading = 1.7;  // at least: a wall is no plane, and the error of a scan's pose
                                              // is in all of its returns

/// The three systematic errors that walls show best: age of the ranges in seconds, scales forward and
/// sideways.
constexpr std::array<SystematicError, 3> kShown{SystematicError::kRangeAge, SystematicError::kForwardScale,
                                                SystematicError::kSidewaysScale};
constexpr Eigen::Index shown(Eigen::Index k) { return index_of(kShown[static_cast<std::size_t>(k)]); }

/// Of those three, around the values assumed.
Eigen::Matrix3d prior_information(const SensorModel& sensor, bool shows_age,
                                  const JointRefinementTuning& tuning) {
  constexpr double kNone = 1e-12;  // variance of an error that is none
  SystematicPrior prior;
  prior.range_age_s = shows_age ? tuning.age_sigma_s : 0.0;
  const SystematicCovariance all = covariance_of(prior, yaw_goes_with_travel(sensor.odometry));
  Eigen::Matrix3d covariance = kNone * Eigen::Matrix3d::Identity();
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      covariance(row, column) += all(shown(row), shown(column));
  return covariance.inverse();
}

std::vector<TimedOdometry> odometry_of(const ScanStore& scans, const OdometryCalibration& calibration) {
  std::vector<TimedOdometry> odometry;
  const std::span<const StoredScan> stored = scans.all().values();
  Pose2 T_odom_body;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (i > 0) T_odom_body = T_odom_body * reported_motion(stored[i - 1], stored[i], calibration);
    odometry.push_back(
        {DeviceTime(stored[i].stamp.time_since_epoch()), T_odom_body, stored[i].starts_segment});
  }
  return odometry;
}

class PosesAndWalls {
 public:
  PosesAndWalls(const ScanStore& scans, const SensorModel& sensor, std::span<const PlacedReturn> returns,
                std::span<const HeadingFactor<PoseIndex>> headings, const BackendTuning& tuning,
                const std::vector<Factor>& factors, const std::vector<Pose2>& T_map_body)
      : motion_(odometry_of(scans, sensor.odometry_calibration)),
        headings_(headings),
        measured_(factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(scans.size() - 1)),
        factors_(factors),
        by_errors_(measured_.size(), Eigen::Matrix3d::Zero()),
        prior_information_(prior_information(sensor, motion_.shows_time_offset(), tuning.joint)),
        min_wall_sigma_m_(kWallSigmasOfReading * sensor.range_sigma_m),
        tuning_(tuning.joint),
        patches_tuning_(tuning.patches),
        scans_(scans.size()),
        T_map_pose_(T_map_body) {
    std::copy_if(returns.begin(), returns.end(), std::back_inserter(returns_),
                 [](const PlacedReturn& r) { return !r.held_out; });
    correct_motions();
  }

  Status associate();
  /// The largest component of the step, in metres or radians.
  Result<double> step();
  [[nodiscard]] std::span<const Pose2> T_map_body() const { return std::span(T_map_pose_).first(scans_); }
  [[nodiscard]] std::vector<Factor>& factors() { return factors_; }

 private:
  [[nodiscard]] WallResidual residual(const WallReturn& wall) const {
    return wall_residual(T_map_pose_[index_of(wall.scan)], T_map_pose_[index_of(wall.patch)], wall.p_body);
  }
  [[nodiscard]] PoseIndex errors_index() const { return make_id<PoseIndex>(T_map_pose_.size() - 1); }
  [[nodiscard]] double wall_sigma_m() const;
  std::vector<PosePair> find_walls();
  void correct_motions();
  void add_motions();
  void add_walls();
  void tie();

  SystematicMotion motion_;
  std::span<const HeadingFactor<PoseIndex>> headings_;
  std::vector<Factor> measured_;  // dead reckoning
  std::vector<Factor> factors_;   // the same, corrected, and closures
  std::vector<Eigen::Matrix3d> by_errors_;
  Eigen::Matrix3d prior_information_;  // of the errors
  double min_wall_sigma_m_;
  JointRefinementTuning tuning_;
  WallPatchesTuning patches_tuning_;
  std::size_t scans_;
  std::vector<Pose2> T_map_pose_;      // of the scans, then of the patches; last the errors
  std::vector<Pose2> found_;           // the patches where they were found
  std::vector<PlacedReturn> returns_;  // but the held-out ones
  std::vector<WallReturn> walls_;
  Eigen::Vector3d errors_ = Eigen::Vector3d::Zero();
  std::optional<PoseSystem> system_;
};

Status PosesAndWalls::associate() {
  system_.reset();  // before the next is built: it is the most that a run ever holds
  const std::vector<PosePair> pairs = find_walls();
  return system_.emplace().prepare_pairs(T_map_pose_.size(), pairs);
}

/// Finds patches and the returns on them. Returns which unknowns are joined.
std::vector<PosePair> PosesAndWalls::find_walls() {
  T_map_pose_.resize(scans_);
  std::vector<DrawnReturn> drawn;
  drawn.reserve(returns_.size());
  for (const PlacedReturn& r : returns_) {
    const Pose2& T = T_map_pose_[index_of(r.pose)];
    const Point2 p = T * r.p_body;
    const double range_m = std::hypot(r.p_body.x_m, r.p_body.y_m);
    drawn.push_back({p, {(p.x_m - T.x_m()) / range_m, (p.y_m - T.y_m()) / range_m}});
  }
  const WallPatches found = find_wall_patches(drawn, patches_tuning_);
  for (const WallPatch& patch : found.patches)
    T_map_pose_.emplace_back(patch.center_map.x_m, patch.center_map.y_m,
                             std::atan2(patch.normal_map.y_m, patch.normal_map.x_m));
  found_.assign(T_map_pose_.begin() + static_cast<std::ptrdiff_t>(scans_), T_map_pose_.end());
  T_map_pose_.emplace_back(errors_(0), errors_(1), errors_(2));
  walls_.clear();
  std::vector<PosePair> pairs;
  pairs.reserve(factors_.size() + scans_ + returns_.size());
  for (const Factor& f : factors_) pairs.push_back({f.from, f.to});
  for (std::size_t i = 0; i < scans_; ++i) pairs.push_back({make_id<PoseIndex>(i), errors_index()});
  for (std::size_t k = 0; k < returns_.size(); ++k) {
    if (found.patch_of[k] == WallPatches::kNone) continue;
    const Point2& normal = found.patches[found.patch_of[k]].normal_map;
    const Point2& beam = drawn[k].direction_map;
    if (-normal.x_m * beam.x_m - normal.y_m * beam.y_m < tuning_.min_incidence_cosine) continue;
    walls_.push_back({returns_[k].pose, make_id<PoseIndex>(scans_ + found.patch_of[k]), returns_[k].p_body});
    pairs.push_back({walls_.back().scan, walls_.back().patch});
  }
  return pairs;
}

/// The returns' robust scatter around their walls.
double PosesAndWalls::wall_sigma_m() const {
  if (walls_.empty()) return min_wall_sigma_m_;
  constexpr double kSigmaPerMedian = 1.4826;  // of normal errors, absolute
  std::vector<double> off_m;
  off_m.reserve(walls_.size());
  for (const WallReturn& wall : walls_) off_m.push_back(std::abs(residual(wall).error_m));
  const auto middle = off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2);
  std::nth_element(off_m.begin(), middle, off_m.end());
  return std::max(min_wall_sigma_m_, kSigmaPerMedian * *middle);
}

/// What the odometry reported is replaced by what it should have; what the frontend learnt of it stays.
void PosesAndWalls::correct_motions() {
  SystematicErrors all = SystematicErrors::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) all(shown(k)) = errors_(k);
  const std::span<const CorrectedStep> steps = motion_.correct(all);
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    if (!motion_.is_known(i + 1)) continue;
    const Pose2 T_measured_inverse = motion_.measured(i + 1).inverse();
    const Pose2 correction = T_measured_inverse * steps[i + 1].T_previous_this;
    factors_[i].T_from_to = measured_[i].T_from_to * correction;
    const Eigen::Matrix3d by_step =
        jacobian_compose_second(measured_[i].T_from_to) * jacobian_compose_second(T_measured_inverse);
    for (Eigen::Index k = 0; k < 3; ++k)
      by_errors_[i].col(k) = by_step * steps[i + 1].by_errors.col(shown(k));
  }
}

void PosesAndWalls::add_motions() {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const Factor& f = factors_[i];
    system_->add(f, 1.0, T_map_pose_);
    const PoseResidual r =
        pose_residual(f.T_from_to, T_map_pose_[index_of(f.from)], T_map_pose_[index_of(f.to)]);
    const Pose2 T_to_from = f.T_from_to.inverse();
    const Pose2 moved = between(T_map_pose_[index_of(f.from)], T_map_pose_[index_of(f.to)]);
    const Eigen::Matrix3d J =
        jacobian_compose_first(T_to_from, moved) * jacobian_inverse(f.T_from_to) * by_errors_[i];
    const Eigen::Matrix3d W = J.transpose() * f.information;
    system_->add(errors_index(), W * J, -W * r.error);
    system_->add(errors_index(), f.from, W * r.J_from);
    system_->add(errors_index(), f.to, W * r.J_to);
  }
}

void PosesAndWalls::add_walls() {
  const double sigma_m = wall_sigma_m();
  for (const WallReturn& wall : walls_) {
    const WallResidual r = residual(wall);
    const double scaled = r.error_m / (tuning_.robust_sigmas * sigma_m);
    const double robust = 1.0 / ((1.0 + scaled * scaled) * (1.0 + scaled * scaled));  // Geman-McClure
    const double weight = robust / (sigma_m * sigma_m);
    system_->add(wall.scan, weight * r.by_scan * r.by_scan.transpose(), -weight * r.error_m * r.by_scan);
    system_->add(wall.patch, weight * r.by_patch * r.by_patch.transpose(), -weight * r.error_m * r.by_patch);
    system_->add(wall.patch, wall.scan, weight * r.by_patch * r.by_scan.transpose());
  }
}

/// Returns leave a patch free along its wall, and one of few returns in its direction. The systematic errors
/// stay near those assumed.
void PosesAndWalls::tie() {
  const double by_distance = 1.0 / (tuning_.patch_distance_sigma_m * tuning_.patch_distance_sigma_m);
  const double by_turn = 1.0 / (tuning_.patch_turn_sigma_rad * tuning_.patch_turn_sigma_rad);
  const Eigen::Vector3d information(by_distance, by_distance, by_turn);
  for (std::size_t m = 0; m < found_.size(); ++m) {
    const Pose2& T = T_map_pose_[scans_ + m];
    const Eigen::Vector3d moved(T.x_m() - found_[m].x_m(), T.y_m() - found_[m].y_m(),
                                wrap_angle(T.yaw_rad() - found_[m].yaw_rad()));
    system_->add(make_id<PoseIndex>(scans_ + m), information.asDiagonal(), -information.cwiseProduct(moved));
  }
  system_->add(errors_index(), prior_information_, -prior_information_ * errors_);
}

Result<double> PosesAndWalls::step() {
  system_->set_zero();
  add_motions();
  for (std::size_t i = measured_.size(); i < factors_.size(); ++i)
    system_->add(factors_[i], tuning_.closure_weight, T_map_pose_);
  for (const HeadingFactor<PoseIndex>& f : headings_) system_->add(f, 1.0, T_map_pose_);
  add_walls();
  tie();
  Result<double> largest = system_->step(T_map_pose_);
  errors_ = T_map_pose_.back().vector();
  correct_motions();
  return largest;
}

}  // namespace

Status refine_jointly(const ScanStore& scans, const SensorModel& sensor,
                      std::span<const PlacedReturn> returns,
                      std::span<const HeadingFactor<PoseIndex>> headings, const BackendTuning& tuning,
                      std::vector<Factor>& factors, std::vector<Pose2>& T_map_body) {
  PosesAndWalls problem(scans, sensor, returns, headings, tuning, factors, T_map_body);
  for (int round = 0; round < tuning.joint.associations; ++round) {
    if (Status status = problem.associate(); !status) return status;
    for (int step = 0; step < tuning.joint.steps_per_association; ++step)
      if (const Result<double> moved = problem.step(); !moved) return moved.error();
  }
  T_map_body.assign(problem.T_map_body().begin(), problem.T_map_body().end());
  factors = std::move(problem.factors());
  return {};
}

}  // namespace swiftlet
