// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/dead_reckoning_misfit.hpp"

#include <Eigen/Cholesky>
#include <cstddef>

#include "core/backend/pose_graph/pose_graph.hpp"

namespace swiftlet {
namespace {

constexpr int kSteps = 3;  // of Gauss-Newton: nearly linear, but for the weights

struct Motion : NodeError {
  Eigen::Vector3d information;
  [[nodiscard]] double chi_square() const { return error.dot(information.cwiseProduct(error)); }
};

Motion motion_to(const RigidNodes& nodes, std::size_t node, std::span<const Pose2> T_map_body) {
  const Pose2 moved = between(T_map_body[nodes.first_scan(node - 1)], T_map_body[nodes.first_scan(node)]);
  const StepVariance& variance = nodes.variance_to(node);
  const double by_xy = 1.0 / variance.xy_m2;
  return {node_error(nodes.next(node - 1), moved), {by_xy, by_xy, 1.0 / variance.yaw_rad2}};
}

}  // namespace

double dead_reckoning_misfit(RigidNodes nodes, const SystematicCovariance& prior,
                             std::span<const Pose2> T_map_body, double dcs_phi) {
  const SystematicCovariance prior_information = information_of(prior);
  SystematicErrors errors = SystematicErrors::Zero();
  for (int step = 0;; ++step) {
    nodes.reckon(errors);
    SystematicCovariance information = prior_information;
    SystematicErrors gradient = prior_information * errors;
    double misfit = 0.5 * errors.dot(gradient);
    for (std::size_t node = 1; node < nodes.size(); ++node) {
      const Motion motion = motion_to(nodes, node, T_map_body);
      const double chi_square = motion.chi_square();
      const double scale = dcs_scale(chi_square, dcs_phi);
      const Eigen::Matrix<double, kSystematicErrors, 3> weighted =
          scale * scale * motion.by_errors.transpose() * motion.information.asDiagonal();
      information += weighted * motion.by_errors;
      gradient += weighted * motion.error;
      misfit += 0.5 * dcs_cost(chi_square, dcs_phi);
    }
    if (step == kSteps) return misfit;
    errors -= information.ldlt().solve(gradient);
  }
}

}  // namespace swiftlet
