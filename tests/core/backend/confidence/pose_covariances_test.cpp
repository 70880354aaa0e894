// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/pose_covariances.hpp"

#include <gtest/gtest.h>

#include "core/backend/confidence/pose_confidence.hpp"
#include "core/geometry/pose_residual.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

constexpr double kStepM = 0.1;

/// Along a line, to and fro: a keyframe every half metre. The way back may lie on another storey.
StoredRun flight(double out_m, double back_m, StoreyId storey_back = {}) {
  std::vector<RangeSample> samples;
  const auto steps = static_cast<int>((out_m + back_m) / kStepM);
  for (int i = 0; i <= steps; ++i) {
    const double way_m = i * kStepM;
    RangeSample sample;
    sample.sequence = static_cast<std::uint32_t>(i);
    if (way_m > out_m) sample.storey = storey_back;
    sample.T_odom_body = Pose2(way_m <= out_m ? way_m : 2.0 * out_m - way_m, 0.0, 0.0);
    samples.push_back(sample);
  }
  return StoredRun(samples);
}

/// Poses by dead reckoning, each motion with the same small covariance.
PoseGraph graph_of(const StoredRun& run) {
  PoseGraph graph;
  const Eigen::Matrix3d P = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  for (const auto& [id, T_local] : run.T_local_keyframe()) {
    if (graph.T_map_keyframe.size() > 0) {
      const KeyframeId before = graph.T_map_keyframe.last_id();
      const Pose2 motion = between(graph.T_map_keyframe[before], T_local);
      graph.factors.push_back({before, id, motion, residual_information(motion, P)});
    }
    graph.T_map_keyframe.push_back(T_local);
  }
  return graph;
}

TEST(PoseCovariances, GrowWithTheWayFromTheStartByNoiseAndSlip) {
  const StoredRun run = flight(10.0, 0.0);
  const ConfidenceTuning tuning;
  const PoseCovariances P = newest_pose_covariances(graph_of(run), run.chain(), {});
  const double motions = static_cast<double>(run.chain().size() - 1);
  const CorrelativeMatcherTuning match;
  EXPECT_NEAR(P.from_start.xx,
              1e-4 * motions + 10.0 * tuning.slip_along_m2_per_m + match.floor_sigma_m * match.floor_sigma_m,
              0.02);
  EXPECT_NEAR(P.from_start.yaw_yaw,
              1e-6 * motions + 10.0 * tuning.slip_yaw_rad2_per_m +
                  match.floor_sigma_yaw_rad * match.floor_sigma_yaw_rad,
              2e-4);
}

TEST(PoseCovariances, OnNewGroundTheSurroundingsAreTheLastFewMetres) {
  const StoredRun run = flight(30.0, 0.0);
  const ConfidenceTuning tuning;
  const PoseCovariances P = newest_pose_covariances(graph_of(run), run.chain(), {});
  EXPECT_LT(P.from_surroundings.xx, (tuning.near_m + 0.5) * tuning.slip_along_m2_per_m + 0.01);
  EXPECT_GT(P.from_surroundings.xx, (tuning.near_m - 0.5) * tuning.slip_along_m2_per_m);
}

TEST(PoseCovariances, OnOldGroundTheyAreWhatWasFlownLongAgo) {
  const StoredRun run = flight(12.0, 12.0);
  PoseGraph graph = graph_of(run);
  const ConfidenceTuning tuning;
  const PoseCovariances before = newest_pose_covariances(graph, run.chain(), {});
  EXPECT_GT(before.from_surroundings.xx, 15.0 * tuning.slip_along_m2_per_m);
  const KeyframeId first = graph.T_map_keyframe.first_id();
  const KeyframeId last = graph.T_map_keyframe.last_id();
  const Pose2 T_first_last = between(graph.T_map_keyframe[first], graph.T_map_keyframe[last]);
  const Eigen::Matrix3d closed = Eigen::Vector3d(0.01, 0.01, 1e-4).asDiagonal();
  graph.factors.push_back({first, last, T_first_last, residual_information(T_first_last, closed), true});
  const PoseCovariances after = newest_pose_covariances(graph, run.chain(), {});
  EXPECT_LT(after.from_surroundings.xx, 0.02);
  EXPECT_LT(after.from_start.xx, 0.02);
}

TEST(PoseCovariances, TheSurroundingsLieOnTheSameStorey) {
  const StoredRun run = flight(12.0, 12.0, make_id<StoreyId>(1));
  const ConfidenceTuning tuning;
  const PoseCovariances P = newest_pose_covariances(graph_of(run), run.chain(), {});
  EXPECT_LT(P.from_surroundings.xx, (tuning.near_m + 0.5) * tuning.slip_along_m2_per_m + 0.01);
}

TEST(PoseCovariances, LieAlongTheAxesOfAMapThatIsTurned) {
  const StoredRun run = flight(10.0, 0.0);
  PoseGraph graph = graph_of(run);
  const Covariance3 before = newest_pose_covariances(graph, run.chain(), {}).from_start;
  for (Pose2& T_map : graph.T_map_keyframe.values()) T_map = Pose2(0.0, 0.0, kPi / 2.0) * T_map;
  const Covariance3 turned = newest_pose_covariances(graph, run.chain(), {}).from_start;
  EXPECT_NEAR(turned.xx, before.yy, 1e-9);
  EXPECT_NEAR(turned.yy, before.xx, 1e-9);
  EXPECT_NEAR(turned.x_yaw, -before.y_yaw, 1e-9);
}

TEST(PoseConfidence, IsCarriedOnAlongTheAxesOfTheMap) {
  PoseConfidence confidence;
  confidence.T_local_keyframe = Pose2(5.0, 0.0, 0.0);
  confidence.yaw_map_local_rad = kPi / 2.0;
  confidence.slip = {.along_m2_per_m = 0.07, .yaw_rad2_per_m = 0.0};
  const Covariance3 of_keyframe{.xx = 0.01, .yy = 0.02, .yaw_yaw = 0.0004};
  // Two metres ahead in frame local are two metres along y of the map, and a heading's error moves them in x.
  const Covariance3 P = carried_on(of_keyframe, confidence, Pose2(7.0, 0.0, 0.0));
  EXPECT_NEAR(P.xx, 0.01 + 4.0 * 0.0004, 1e-12);
  EXPECT_NEAR(P.yy, 0.02 + 2.0 * 0.07, 1e-12);
  EXPECT_NEAR(P.x_yaw, -2.0 * 0.0004, 1e-12);
}

}  // namespace
}  // namespace swiftlet
