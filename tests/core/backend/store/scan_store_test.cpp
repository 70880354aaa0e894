// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/scan_store.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace swiftlet {
namespace {

FrontendStep step_at(const Pose2& T_odom_body, bool starts_segment = false) {
  FrontendStep step;
  step.sample.T_odom_body = T_odom_body;
  step.sample.starts_segment = starts_segment;
  step.sample.beam_count = 4;
  step.sample.status.fill(RangeStatus::kInvalid);
  return step;
}

TEST(ScanStore, KeepsWhatTheScanSaidInOrder) {
  ScanStore scans(BeamLayout::multiranger());
  EXPECT_EQ(scans.add(step_at({}, true)), ScanId{0});
  FrontendStep step = step_at({1.0, 2.0, 0.5});
  step.sample.stamp = HostTime(std::chrono::seconds(77));
  step.keyframe = KeyframeId{3};
  step.T_keyframe_body = Pose2(0.1, 0.2, 0.3);
  EXPECT_EQ(scans.add(step), ScanId{1});
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_TRUE(scans[ScanId{0}].starts_segment);
  const StoredScan& scan = scans[ScanId{1}];
  EXPECT_FALSE(scan.starts_segment);
  EXPECT_EQ(scan.stamp, step.sample.stamp);
  EXPECT_EQ(scan.keyframe, KeyframeId{3});
  EXPECT_EQ(scan.T_odom_body.vector(), step.sample.T_odom_body.vector());
  EXPECT_EQ(scan.T_keyframe_body.vector(), step.T_keyframe_body.vector());
}

TEST(ScanStore, StoresHitsAndMissesAndLeavesOutWhatIsInvalid) {
  ScanStore scans(BeamLayout::multiranger());
  FrontendStep step = step_at({}, true);
  step.sample.status[0] = RangeStatus::kHit;
  step.sample.distance_m[0] = 1.5F;
  step.sample.status[2] = RangeStatus::kNoReturn;
  scans.add(step);
  scans.add(step_at({}));
  ASSERT_EQ(scans.returns(ScanId{0}).size(), 2U);
  EXPECT_TRUE(scans.returns(ScanId{0})[0].is_hit);
  EXPECT_EQ(scans.returns(ScanId{0})[0].beam, 0);
  EXPECT_EQ(scans.returns(ScanId{0})[0].distance_m, 1.5F);
  EXPECT_FALSE(scans.returns(ScanId{0})[1].is_hit);
  EXPECT_EQ(scans.returns(ScanId{0})[1].beam, 2);
  EXPECT_TRUE(scans.returns(ScanId{1}).empty());
}

TEST(ScanStore, BeamsBeyondTheSamplesCountAreNotRead) {
  ScanStore scans(BeamLayout::multiranger());
  FrontendStep step = step_at({}, true);
  step.sample.beam_count = 2;
  step.sample.status.fill(RangeStatus::kHit);
  scans.add(step);
  EXPECT_EQ(scans.returns(ScanId{0}).size(), 2U);
}

TEST(ScanStore, GivesTheSamplesBack) {
  ScanStore scans(BeamLayout::multiranger());
  FrontendStep step = step_at({1.0, 2.0, 0.5}, true);
  RangeSample& given = step.sample;
  given.stamp = HostTime(std::chrono::seconds(77));
  given.measured_at = DeviceTime(std::chrono::seconds(3));
  given.odometry_ran_on = true;
  given.storey = StoreyId{2};
  given.status[0] = RangeStatus::kHit;
  given.distance_m[0] = 1.5F;
  given.status[2] = RangeStatus::kNoReturn;
  scans.add(step);
  scans.add(step_at({}));
  const std::vector<RangeSample> samples = scans.samples();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[1].sequence, 1U);
  const RangeSample& back = samples[0];
  EXPECT_EQ(back.stamp, given.stamp);
  EXPECT_EQ(back.measured_at, given.measured_at);
  EXPECT_EQ(back.T_odom_body.vector(), given.T_odom_body.vector());
  EXPECT_TRUE(back.starts_segment);
  EXPECT_TRUE(back.odometry_ran_on);
  EXPECT_EQ(back.storey, given.storey);
  EXPECT_EQ(back.beam_count, 4);
  EXPECT_EQ(back.status, given.status);
  EXPECT_EQ(back.distance_m, given.distance_m);
}

TEST(ScanStore, ReturnsLieAlongTheirBeams) {
  const ScanStore scans(BeamLayout::multiranger());
  const Point2 front = scans.point_body({2.0F, 0, true});
  EXPECT_NEAR(front.x_m, 2.0, 1e-12);
  EXPECT_NEAR(front.y_m, 0.0, 1e-12);
  const Point2 right = scans.point_body({0.5F, 3, true});
  EXPECT_NEAR(right.x_m, 0.0, 1e-12);
  EXPECT_NEAR(right.y_m, -0.5, 1e-12);
}

TEST(ScanStore, PathAddsUpTravelAndNotTurns) {
  ScanStore scans(BeamLayout::multiranger());
  scans.add(step_at({5.0, 5.0, 0.0}, true));
  scans.add(step_at({8.0, 9.0, 0.0}));
  scans.add(step_at({8.0, 9.0, 2.0}));
  scans.add(step_at({8.0, 8.0, 2.0}));
  EXPECT_DOUBLE_EQ(scans[ScanId{0}].path_m, 0.0);
  EXPECT_DOUBLE_EQ(scans[ScanId{1}].path_m, 5.0);
  EXPECT_DOUBLE_EQ(scans[ScanId{2}].path_m, 5.0);
  EXPECT_DOUBLE_EQ(scans[ScanId{3}].path_m, 6.0);
}

TEST(ScanStore, TheJumpIntoANewSegmentIsNotTravel) {
  ScanStore scans(BeamLayout::multiranger());
  scans.add(step_at({}, true));
  scans.add(step_at({1.0, 0.0, 0.0}));
  scans.add(step_at({100.0, 0.0, 0.0}, true));
  scans.add(step_at({102.0, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(scans[ScanId{2}].path_m, 1.0);
  EXPECT_DOUBLE_EQ(scans[ScanId{3}].path_m, 3.0);
}

TEST(ScanStore, WhatIsErasedIsGoneAndTheRestKeepsWhatItSaid) {
  ScanStore scans(BeamLayout::multiranger());
  for (std::uint32_t i = 0; i < 9; ++i) {
    FrontendStep step = step_at(Pose2(i, 0.0, 0.0), i == 0);
    step.sample.status[i % 4] = RangeStatus::kHit;
    step.sample.distance_m[i % 4] = static_cast<float>(i);
    step.keyframe = make_id<KeyframeId>(i / 3);
    scans.add(step);
  }
  IdRanges<ScanId> gone;
  gone.add({ScanId{3}, ScanId{6}});
  scans.erase(gone);
  ASSERT_EQ(scans.size(), 6U);
  for (const auto& [id, scan] : scans.all()) {
    EXPECT_EQ(index_of(scan.keyframe), index_of(id) / 3);
    ASSERT_EQ(scans.returns(id).size(), 1U);
    EXPECT_EQ(scans.returns(id)[0].distance_m, static_cast<float>(index_of(id)));
    EXPECT_EQ(scan.starts_segment, id == ScanId{0} || id == ScanId{6}) << "after a hole begins a segment";
  }
  EXPECT_EQ(scans.return_count({ScanId{1}, ScanId{7}}), 3U);
  EXPECT_EQ(scans.add(step_at(Pose2(9.0, 0.0, 0.0))), ScanId{9});
  EXPECT_DOUBLE_EQ(scans[ScanId{9}].path_m, 9.0);
}

}  // namespace
}  // namespace swiftlet
