// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/backend/store/keyframe_chain.hpp"
#include "core/base/id_map.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// One relative measurement between two poses, z = T_from_to.
template <AnId Id>
struct RelativePoseFactor {
  Id from{};
  Id to{};
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of z's error, in the frame of `to` (eq. 24)
  bool is_closure = false;                                    ///< subject to DCS
  double dcs_scale = 1.0;  ///< written by the optimizer: 1 fully weighted, towards 0 refused

  /// The same measurement between the same poses by their other ids.
  template <AnId Other>
  [[nodiscard]] RelativePoseFactor<Other> joining(Other other_from, Other other_to) const {
    return {other_from, other_to, T_from_to, information, is_closure, dcs_scale};
  }
};

/// A pose's heading, known by other means than motion. Subject to DCS.
template <AnId Id>
struct HeadingFactor {
  Id pose{};
  double yaw_map_rad = 0.0;
  double information = 1.0;  ///< 1 / rad^2
  double dcs_scale = 1.0;    ///< as a RelativePoseFactor's

  /// The same heading of the same pose by its other id.
  template <AnId Other>
  [[nodiscard]] HeadingFactor<Other> of(Other other) const {
    return {other, yaw_map_rad, information, dcs_scale};
  }
};

struct PoseGraph {
  KeyframePoses T_map_keyframe;  ///< the first one is held fixed
  IdMap<FactorId, RelativePoseFactor<KeyframeId>> factors;
  std::vector<HeadingFactor<KeyframeId>> headings;
  /// Motions between neighbours as they were measured, subject to DCS; one that was wrong has no information.
  std::vector<FactorId> doubted;

  /// Of a keyframe among the poses of the problem that a solver makes of the graph.
  [[nodiscard]] PoseIndex pose_index(KeyframeId id) const {
    return make_id<PoseIndex>(T_map_keyframe.position(id));
  }
};

/// How far the poses are from what is measured, in units of the measurement's noise.
[[nodiscard]] double chi_square(const RelativePoseFactor<KeyframeId>& factor,
                                const KeyframePoses& T_map_keyframe);
[[nodiscard]] double chi_square(const HeadingFactor<KeyframeId>& factor, const KeyframePoses& T_map_keyframe);
[[nodiscard]] double chi_square(const RelativePoseFactor<PoseIndex>& factor,
                                const std::vector<Pose2>& T_map_pose);
[[nodiscard]] double chi_square(const HeadingFactor<PoseIndex>& factor, const std::vector<Pose2>& T_map_pose);

/// DCS (Agarwal et al. 2013, "Robust map optimization using dynamic covariance scaling", eq. 15): the factor
/// on a closure's error of the given chi-square.
double dcs_scale(double chi_square, double phi);
/// What weights of dcs_scale() squared minimise, their integral over chi-square: at most 3 phi.
double dcs_cost(double chi_square, double phi);

}  // namespace swiftlet
