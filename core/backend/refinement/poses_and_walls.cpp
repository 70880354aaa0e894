// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/poses_and_walls.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/geometry/angle.hpp"
#include "core/geometry/geman_mcclure.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {
namespace {

constexpr double kHeldInformation = 1e12;  // of the first node

std::vector<Pose2> poses_of_nodes(const RigidNodes& nodes, std::span<const Pose2> T_map_body) {
  std::vector<Pose2> T_map_node;
  for (std::size_t k = 0; k < nodes.size(); ++k) T_map_node.push_back(T_map_body[nodes.first_scan(k)]);
  return T_map_node;
}

}  // namespace

PosesAndWalls::PosesAndWalls(RigidNodes nodes, std::vector<ScanHit> hits, PoseKnowledge known,
                             std::span<const Pose2> T_map_body, const SystematicCovariance& prior,
                             double min_wall_sigma_m, const Tuning& tuning)
    : tuning_(tuning),
      nodes_(std::move(nodes)),
      hits_(std::move(hits)),
      known_(std::move(known)),
      prior_information_(information_of(prior)),
      min_wall_sigma_m_(min_wall_sigma_m),
      wall_sigma_m_(min_wall_sigma_m),
      T_map_node_(poses_of_nodes(nodes_, T_map_body)) {
  for (std::size_t k = 0; k < kSystematicErrors; ++k)
    is_error_[k] = prior(static_cast<Index>(k), static_cast<Index>(k)) > 0.0;
}

void PosesAndWalls::associate() {
  forget_equations();  // before patches are found: both take much memory
  const std::vector<DrawnReturn> returns = drawn();
  take(find_patches(returns), returns);
}

void PosesAndWalls::associate_with(const WallPatches& found) {
  forget_equations();
  take(found, drawn());
}

void PosesAndWalls::forget_equations() {
  solver_.reset();
  H_.reset();
}

std::vector<DrawnReturn> PosesAndWalls::drawn() const {
  std::vector<DrawnReturn> drawn;
  drawn.reserve(hits_.size());
  Pose2 T;  // of the hit's scan; the hits of one follow each other
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const ScanHit& hit = hits_[k];
    if (k == 0 || hit.scan != hits_[k - 1].scan) T = T_map_scan(hit.scan);
    const Point2 p = T * hit.p_body;
    const double range_m = std::hypot(hit.p_body.x_m, hit.p_body.y_m);
    drawn.push_back({p, {(p.x_m - T.x_m()) / range_m, (p.y_m - T.y_m()) / range_m}});
  }
  return drawn;
}

void PosesAndWalls::take(const WallPatches& found, std::span<const DrawnReturn> drawn) {
  patches_.clear();
  for (const WallPatch& patch : found.patches) patches_.push_back({patch, 0.0, 0.0});
  find_sights(found, drawn);
  if (floor_) find_floor_sights();
}

/// A storey at a time.
WallPatches PosesAndWalls::find_patches(std::span<const DrawnReturn> drawn) const {
  const auto is_on_first = [&](const ScanHit& hit) { return hit.storey == hits_.front().storey; };
  if (std::ranges::all_of(hits_, is_on_first))
    return find_wall_patches(drawn, tuning_.fit, tuning_.patches);  // without a copy: it can be large
  WallPatches found;
  found.patch_of.assign(drawn.size(), WallPatches::kNone);
  std::array<std::vector<std::uint32_t>, kMaxStoreys> hits_on;  // by storey
  for (std::uint32_t k = 0; k < hits_.size(); ++k) hits_on[index_of(hits_[k].storey)].push_back(k);
  for (const std::vector<std::uint32_t>& hits : hits_on) {
    if (hits.empty()) continue;
    std::vector<DrawnReturn> drawn_here;
    drawn_here.reserve(hits.size());
    for (const std::uint32_t k : hits) drawn_here.push_back(drawn[k]);
    const WallPatches here = find_wall_patches(drawn_here, tuning_.fit, tuning_.patches);
    const auto first = static_cast<std::uint32_t>(found.patches.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (here.patch_of[i] != WallPatches::kNone) found.patch_of[hits[i]] = first + here.patch_of[i];
    found.patches.insert(found.patches.end(), here.patches.begin(), here.patches.end());
  }
  return found;
}

/// The returns that meet their patch steeply, by node.
void PosesAndWalls::find_sights(const WallPatches& found, std::span<const DrawnReturn> drawn) {
  returns_.clear();
  sights_.clear();
  std::vector<std::uint32_t> seen;  // patches
  const auto end_node = [&](std::size_t node, std::size_t first_return) {
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (std::size_t k = first_return; k < returns_.size(); ++k) {
      const auto at = std::lower_bound(seen.begin(), seen.end(), returns_[k].patch) - seen.begin();
      returns_[k].sight = static_cast<std::uint32_t>(sights_.size()) + static_cast<std::uint32_t>(at);
    }
    for (const std::uint32_t patch : seen) sights_.push_back({static_cast<std::uint32_t>(node), patch});
    seen.clear();
  };
  std::size_t first_return = 0;  // of the node
  for (std::uint32_t k = 0; k < hits_.size(); ++k) {
    const std::size_t node = nodes_.node_of(hits_[k].scan);
    if (k > 0 && nodes_.node_of(hits_[k - 1].scan) != node) {
      end_node(nodes_.node_of(hits_[k - 1].scan), first_return);
      first_return = returns_.size();
    }
    const std::uint32_t patch = found.patch_of[k];
    if (patch == WallPatches::kNone) continue;
    const Point2& normal = found.patches[patch].normal_map;
    const Point2& beam = drawn[k].direction_map;
    if (-normal.x_m * beam.x_m - normal.y_m * beam.y_m < tuning_.walls.min_incidence_cosine) continue;
    returns_.push_back({k, patch, 0});
    seen.push_back(patch);
  }
  if (!hits_.empty()) end_node(nodes_.node_of(hits_.back().scan), first_return);
}

/// Behind those of the patches. A node without returns lies on the storey of the one before.
void PosesAndWalls::find_floor_sights() {
  std::vector<PlaceOnFloor> places;
  places.reserve(nodes_.size());
  std::size_t hit = 0;
  StoreyId storey = hits_.empty() ? StoreyId{} : hits_.front().storey;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    for (; hit < hits_.size() && nodes_.node_of(hits_[hit].scan) <= k; ++hit) storey = hits_[hit].storey;
    places.push_back({T_map_node_[k].position(), storey});
  }
  floor_->place(places);
  const auto new_sight = [&](std::size_t node, std::size_t cell) {
    sights_.push_back({static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(patches_.size() + cell)});
    return static_cast<std::uint32_t>(sights_.size() - 1);
  };
  floor_sights_.assign(nodes_.size(), {});
  for (std::size_t k = 1; k < nodes_.size(); ++k) {
    const std::size_t cell = floor_->cell_of(k);
    const bool goes_on = k > 1 && cell == floor_->cell_of(k - 1);
    floor_sights_[k].from = goes_on ? floor_sights_[k - 1].to : new_sight(k - 1, cell);
    floor_sights_[k].to = new_sight(k, cell);
  }
}

/// With the pattern of the present patches.
NodePatchMatrix PosesAndWalls::matrix() const {
  std::vector<NodePatchMatrix::NodePair> pairs;
  for (std::uint32_t k = 1; k < nodes_.size(); ++k) pairs.push_back({k - 1, k});
  for (const RelativePoseFactor<PoseIndex>& f : known_.closures) {
    const auto [earlier, later] =
        std::minmax({nodes_.node_of(index_of(f.from)), nodes_.node_of(index_of(f.to))});
    if (earlier < later)
      pairs.push_back({static_cast<std::uint32_t>(earlier), static_cast<std::uint32_t>(later)});
  }
  const std::size_t cells = floor_ ? floor_->size() : 0;
  return {nodes_.size(), patches_.size() + cells, std::move(pairs), sights_};
}

PosesAndWalls::WallRow PosesAndWalls::wall_row(const WallReturn& wall) const {
  const ScanHit& hit = hits_[wall.hit];
  const PoseInNode& scan = nodes_.in_node(hit.scan);
  const Pose2& T = T_map_node_[nodes_.node_of(hit.scan)];
  const PatchState& patch = patches_[wall.patch];
  // A turn is small; a patch's direction needs no more than its first order.
  const Point2& n = patch.at.normal_map;
  const Point2 normal{n.x_m - patch.turn_rad * n.y_m, n.y_m + patch.turn_rad * n.x_m};
  const Point2 p_node = scan.T_node_body * hit.p_body;
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
  const double robust = 1.0 / geman_mcclure_divisor(row.error / (tuning_.fit.robust_sigmas * wall_sigma_m_));
  row.weight = robust / (wall_sigma_m_ * wall_sigma_m_);
  return row;
}

/// The next node as it is, in the frame in which dead reckoning predicts it.
PosesAndWalls::MotionRow PosesAndWalls::motion_row(std::size_t to) const {
  const Pose2& T_map_from = T_map_node_[to - 1];
  const Pose2& T_map_to = T_map_node_[to];
  const PoseInNode& predicted = nodes_.next(to - 1);
  const Pose2 T_from_map = T_map_from.inverse();
  const Pose2 moved = T_from_map * T_map_to;
  const Pose2 T_predicted_from = predicted.T_node_body.inverse();
  const Eigen::Matrix3d by_moved = jacobian_compose_second(T_predicted_from);
  MotionRow row;
  const NodeError off = node_error(predicted, moved);
  row.error = off.error;
  row.by_from = by_moved * jacobian_compose_first(T_from_map, T_map_to) * jacobian_inverse(T_map_from);
  row.by_to = by_moved * jacobian_compose_second(T_from_map);
  row.by_errors = off.by_errors;
  const StepVariance& variance = nodes_.variance_to(to);
  const double by_xy = 1.0 / (position_noise_scale_ * position_noise_scale_ * variance.xy_m2);
  row.weight << by_xy, by_xy, 1.0 / variance.yaw_rad2;
  if (floor_) {
    row.by_floor = row.by_errors.col(index_of(SystematicError::kForwardScale)) +
                   row.by_errors.col(index_of(SystematicError::kSidewaysScale));
    row.error += floor_->error(floor_->cell_of(to)) * row.by_floor;
  }
  return row;
}

void PosesAndWalls::measure_wall_sigma() {
  if (returns_.empty()) return;
  constexpr double kSigmaPerMedian = 1.4826;  // of normal errors, absolute
  std::vector<double> off_m;
  off_m.reserve(returns_.size());
  for (const WallReturn& wall : returns_) off_m.push_back(std::abs(wall_row(wall).error));
  const auto middle = off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2);
  std::nth_element(off_m.begin(), middle, off_m.end());
  wall_sigma_m_ = std::max(min_wall_sigma_m_, kSigmaPerMedian * *middle);
}

/// Returns leave a patch free along its wall, and one of few returns in its direction.
void PosesAndWalls::gather_patches() {
  const PosesAndWallsTuning& t = tuning_.walls;
  const Eigen::Vector2d tie(1.0 / (t.patch_distance_sigma_m * t.patch_distance_sigma_m),
                            1.0 / (t.patch_turn_sigma_rad * t.patch_turn_sigma_rad));
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    H_->add_patch(m, tie.asDiagonal());
    gradient_.segment<2>(H_->row_of_patch(m)) +=
        tie.cwiseProduct(Eigen::Vector2d(patches_[m].distance_m, patches_[m].turn_rad));
  }
}

void PosesAndWalls::gather_walls() {
  for (const WallReturn& wall : returns_) {
    const WallRow row = wall_row(wall);
    const Eigen::Vector3d by_node = row.weight * row.by_node;
    const Eigen::Vector2d by_patch = row.weight * row.by_patch;
    const std::size_t node = sights_[wall.sight].node;
    H_->add_node(node, by_node * row.by_node.transpose());
    H_->add_patch(wall.patch, by_patch * row.by_patch.transpose());
    H_->add_sight(wall.sight, by_patch * row.by_node.transpose());
    const Index at_node = H_->row_of_node(node);
    const Index at_patch = H_->row_of_patch(wall.patch);
    gradient_.segment<3>(at_node) += row.error * by_node;
    gradient_.segment<2>(at_patch) += row.error * by_patch;
    H_errors_.middleRows<3>(at_node).noalias() += by_node * row.by_errors.transpose();
    H_errors_.middleRows<2>(at_patch).noalias() += by_patch * row.by_errors.transpose();
    errors_information_.noalias() += row.weight * row.by_errors * row.by_errors.transpose();
    errors_gradient_ += row.weight * row.error * row.by_errors;
  }
}

/// Of the two unknowns of a patch a cell has the first; the second is held.
void PosesAndWalls::gather_floor_prior() {
  for (std::size_t c = 0; c < floor_->size(); ++c) {
    const std::size_t patch = patches_.size() + c;
    H_->add_patch(patch, Eigen::Vector2d(floor_->information(c), 1.0).asDiagonal());
    gradient_(H_->row_of_patch(patch)) += floor_->information(c) * floor_->error(c);
  }
}

void PosesAndWalls::gather_floor(std::size_t to, const MotionRow& row) {
  const std::size_t patch = patches_.size() + floor_->cell_of(to);
  Eigen::Matrix<double, 2, 3> A = Eigen::Matrix<double, 2, 3>::Zero();
  A.row(0) = row.by_floor.cwiseProduct(row.weight);
  Eigen::Matrix2d by_itself = Eigen::Matrix2d::Zero();
  by_itself(0, 0) = A.row(0) * row.by_floor;
  H_->add_patch(patch, by_itself);
  H_->add_sight(floor_sights_[to].from, A * row.by_from);
  H_->add_sight(floor_sights_[to].to, A * row.by_to);
  gradient_.segment<2>(H_->row_of_patch(patch)) += A * row.error;
  H_errors_.middleRows<2>(H_->row_of_patch(patch)) += A * row.by_errors;
}

void PosesAndWalls::gather_motions() {
  if (floor_) gather_floor_prior();
  for (std::uint32_t k = 1; k < nodes_.size(); ++k) {
    const MotionRow row = motion_row(k);
    if (floor_) gather_floor(k, row);
    const Index from = H_->row_of_node(k - 1);
    const Index to = H_->row_of_node(k);
    const Eigen::Matrix3d A = row.by_from.transpose() * row.weight.asDiagonal();
    const Eigen::Matrix3d B = row.by_to.transpose() * row.weight.asDiagonal();
    H_->add_node(k - 1, A * row.by_from);
    H_->add_node(k, B * row.by_to);
    H_->add_pair({k - 1, k}, B * row.by_from);
    gradient_.segment<3>(from) += A * row.error;
    gradient_.segment<3>(to) += B * row.error;
    H_errors_.middleRows<3>(from) += A * row.by_errors;
    H_errors_.middleRows<3>(to) += B * row.by_errors;
    const Eigen::Matrix<double, kSystematicErrors, 3> C = row.by_errors.transpose() * row.weight.asDiagonal();
    errors_information_ += C * row.by_errors;
    errors_gradient_ += C * row.error;
  }
}

/// Between nodes: what age and scales move a scan within its node is millimetres.
void PosesAndWalls::gather_known() {
  const auto node_of = [&](PoseIndex scan) {
    return static_cast<std::uint32_t>(nodes_.node_of(index_of(scan)));
  };
  const auto by_node = [&](PoseIndex scan) {
    return jacobian_compose_first(T_map_node_[node_of(scan)], nodes_.in_node(index_of(scan)).T_node_body);
  };
  for (const RelativePoseFactor<PoseIndex>& f : known_.closures) {
    const std::uint32_t from = node_of(f.from);
    const std::uint32_t to = node_of(f.to);
    if (from == to) continue;
    const PoseResidual r =
        pose_residual(f.T_from_to, T_map_scan(index_of(f.from)), T_map_scan(index_of(f.to)));
    const Eigen::Matrix3d by_from = r.J_from * by_node(f.from);
    const Eigen::Matrix3d by_to = r.J_to * by_node(f.to);
    const Eigen::Matrix3d A = by_from.transpose() * (known_.closure_weight * f.information);
    const Eigen::Matrix3d B = by_to.transpose() * (known_.closure_weight * f.information);
    H_->add_node(from, A * by_from);
    H_->add_node(to, B * by_to);
    if (from < to)
      H_->add_pair({from, to}, B * by_from);
    else
      H_->add_pair({to, from}, A * by_to);
    gradient_.segment<3>(H_->row_of_node(from)) += A * r.error;
    gradient_.segment<3>(H_->row_of_node(to)) += B * r.error;
  }
  for (const HeadingFactor<PoseIndex>& f : known_.headings) {
    H_->add_node(node_of(f.pose), Eigen::Vector3d(0.0, 0.0, f.information).asDiagonal());
    gradient_(H_->row_of_node(node_of(f.pose)) + 2) +=
        f.information * wrap_angle(T_map_scan(index_of(f.pose)).yaw_rad() - f.yaw_map_rad);
  }
}

void PosesAndWalls::gather() {
  if (!H_) H_.emplace(matrix());
  H_->set_zero();
  gradient_.setZero(H_->upper().rows());
  H_errors_.setZero(H_->upper().rows(), Eigen::NoChange);
  errors_information_ = prior_information_;
  errors_gradient_ = prior_information_ * errors_;
  H_->add_node(0, kHeldInformation * Eigen::Matrix3d::Identity());
  gather_patches();
  gather_walls();
  gather_motions();
  gather_known();
  for (Index k = 0; k < H_errors_.cols(); ++k)
    if (!is_error_[static_cast<std::size_t>(k)]) H_errors_.col(k).setZero();
}

void PosesAndWalls::move(const Eigen::VectorXd& unknowns, const SystematicErrors& errors) {
  for (std::size_t k = 0; k < T_map_node_.size(); ++k) {
    const Eigen::Vector3d moved = T_map_node_[k].vector() + unknowns.segment<3>(H_->row_of_node(k));
    T_map_node_[k] = Pose2(moved(0), moved(1), moved(2));
  }
  for (std::size_t m = 0; m < patches_.size(); ++m) {
    const auto d = unknowns.segment<2>(H_->row_of_patch(m));
    patches_[m].distance_m += d(0);
    patches_[m].turn_rad += d(1);
  }
  if (floor_)
    for (std::size_t c = 0; c < floor_->size(); ++c)
      floor_->change(c, unknowns(H_->row_of_patch(patches_.size() + c)));
  errors_ += errors;
  nodes_.reckon(errors_);
}

Status PosesAndWalls::step() {
  measure_wall_sigma();
  gather();
  if (!solver_) solver_.emplace().analyzePattern(H_->upper());
  solver_->factorize(H_->upper());
  if (solver_->info() != Eigen::Success)
    return Error{ErrorCode::kSolver,
                 "the joint problem of poses, walls and systematic errors has no solution"};
  by_errors_.setZero(gradient_.size(), Eigen::NoChange);
  for (Index k = 0; k < by_errors_.cols(); ++k)
    if (is_error_[static_cast<std::size_t>(k)]) by_errors_.col(k) = solver_->solve(H_errors_.col(k));
  const Eigen::VectorXd settled = solver_->solve(gradient_);
  reduced_ = errors_information_ - H_errors_.transpose() * by_errors_;
  change_ = -reduced_.ldlt().solve(errors_gradient_ - H_errors_.transpose() * settled);
  const Eigen::VectorXd unknowns = -settled - by_errors_ * change_;
  if (!unknowns.allFinite() || !change_.allFinite())
    return Error{ErrorCode::kSolver, "the joint problem of poses, walls and systematic errors diverged"};
  move(unknowns, change_);
  return {};
}

PosesAndWalls::ErrorsMatrix PosesAndWalls::scatter(std::span<const std::size_t> group_of_scan) const {
  std::vector<SystematicErrors> gradients(group_of_scan.back() + 1, SystematicErrors::Zero());
  for (const WallReturn& wall : returns_) {
    const WallRow row = wall_row(wall);
    const Index node = H_->row_of_node(sights_[wall.sight].node);
    const SystematicErrors by_errors =
        row.by_errors - by_errors_.middleRows<3>(node).transpose() * row.by_node -
        by_errors_.middleRows<2>(H_->row_of_patch(wall.patch)).transpose() * row.by_patch;
    gradients[group_of_scan[hits_[wall.hit].scan]] += row.weight * row.error * by_errors;
  }
  for (std::size_t k = 1; k < nodes_.size(); ++k) {
    const MotionRow row = motion_row(k);
    const Eigen::Matrix<double, 3, kSystematicErrors> by_errors =
        row.by_errors - row.by_from * by_errors_.middleRows<3>(H_->row_of_node(k - 1)) -
        row.by_to * by_errors_.middleRows<3>(H_->row_of_node(k));
    gradients[group_of_scan[nodes_.first_scan(k)]] +=
        by_errors.transpose() * row.weight.cwiseProduct(row.error);
  }
  ErrorsMatrix scatter = ErrorsMatrix::Zero();
  for (const SystematicErrors& g : gradients) scatter += g * g.transpose();
  return scatter;
}

}  // namespace swiftlet
