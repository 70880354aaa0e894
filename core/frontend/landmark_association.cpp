// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_association.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

/// Of an observed line.
struct LineEnds {
  Point2 start_local;
  Point2 end_local;
};

// The left side of eq. (5).
double projection_error_m(const Landmark& landmark, const LineEnds& observed) {
  return std::abs(landmark.line_local.distance_m(observed.start_local)) +
         std::abs(landmark.line_local.distance_m(observed.end_local));
}

// Eq. (8), in metres; negative when they miss one another.
double overlap_m(const Landmark& landmark, const LineEnds& observed) {
  const Line2& line = landmark.line_local;
  const auto [s1, s2] = std::minmax({line.along_m(landmark.start_local), line.along_m(landmark.end_local)});
  const auto [t1, t2] = std::minmax({line.along_m(observed.start_local), line.along_m(observed.end_local)});
  return std::min(s2, t2) - std::max(s1, t1);
}

bool shows_same_face(const Landmark& landmark, const Point2& seen_from_local) {
  return landmark.line_local.distance_m(landmark.seen_from_local) *
             landmark.line_local.distance_m(seen_from_local) >=
         0.0;
}

// Squared Mahalanobis distance of the two lines, two degrees of freedom.
double mahalanobis2(const Landmark& landmark, const LineSegment& segment, const Viewpoint& viewpoint) {
  const LineError e = line_error(segment.line, viewpoint.T_local_body, landmark.line_local);
  const Eigen::Matrix2d S = segment.covariance + e.J_pose * viewpoint.covariance * e.J_pose.transpose() +
                            e.J_line * landmark.covariance * e.J_line.transpose();
  return e.error.dot(S.inverse() * e.error);
}

}  // namespace

std::optional<std::size_t> associate(std::span<const Landmark> landmarks, const LineSegment& segment,
                                     const Viewpoint& viewpoint, KeyframeId oldest,
                                     const FrontendConfig& config) {
  const LineEnds observed{viewpoint.T_local_body * segment.start, viewpoint.T_local_body * segment.end};
  std::optional<std::size_t> nearest;
  double nearest_error_m = config.association_error_m;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = landmarks[i];
    if (landmark.last_seen < oldest) continue;
    const double error_m = projection_error_m(landmark, observed);
    if (error_m > nearest_error_m) continue;
    if (overlap_m(landmark, observed) < -config.association_gap_m) continue;
    if (!shows_same_face(landmark, viewpoint.T_local_body.position())) continue;
    if (mahalanobis2(landmark, segment, viewpoint) > config.association_mahalanobis2) continue;
    nearest = i;
    nearest_error_m = error_m;
  }
  return nearest;
}

}  // namespace swiftlet
