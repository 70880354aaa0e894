// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/keyframe_chain.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr double kExact = 1e-12;

/// Scans along a wandering path with a keyframe at every `spacing`-th.
class KeyframeChainTest : public testing::Test {
 protected:
  void fly(int scan_count, int spacing, int segment_starts_at = -1) {
    std::mt19937 random(41);
    Pose2 T_odom_body = random_pose(random, 5.0);
    Pose2 T_odom_keyframe;
    for (int i = 0; i < scan_count; ++i) {
      FrontendStep step;
      if (i % spacing == 0) {
        T_odom_keyframe = T_odom_body;
        T_odom_keyframes_.push_back(T_odom_body);
      }
      step.sample.T_odom_body = T_odom_body;
      step.T_dead_body = T_odom_body;
      step.sample.starts_segment = i == 0 || i == segment_starts_at;
      step.keyframe = T_odom_keyframes_.last_id();
      step.T_keyframe_body = between(T_odom_keyframe, T_odom_body);
      const ScanId scan = scans_.add(step);
      if (i % spacing == 0) chain_.add(scan);
      T_odom_body = T_odom_body * Pose2(random_in(random, 0.0, 0.2), 0.0, random_in(random, -0.2, 0.2));
    }
  }

  ScanStore scans_{BeamLayout::multiranger()};
  KeyframeChain chain_{scans_};
  KeyframePoses T_odom_keyframes_;
};

TEST_F(KeyframeChainTest, KnowsTheScanAndThePathOfEachKeyframe) {
  fly(21, 10);
  ASSERT_EQ(chain_.size(), 3U);
  EXPECT_EQ(chain_.scan_of(KeyframeId{0}), ScanId{0});
  EXPECT_EQ(chain_.scan_of(KeyframeId{2}), ScanId{20});
  EXPECT_EQ(chain_.path_m(KeyframeId{2}), scans_[ScanId{20}].path_m);
}

TEST_F(KeyframeChainTest, HitsEveryKeyframeExactlyWhereverItIsMovedTo) {
  fly(31, 10);
  std::mt19937 random(42);
  KeyframePoses T_map_keyframe;
  for (std::size_t k = 0; k < chain_.size(); ++k) T_map_keyframe.push_back(random_pose(random, 5.0));
  for (const auto& [keyframe, scan] : chain_.all())
    EXPECT_TRUE(poses_near(chain_.T_w_body(scan, T_map_keyframe), T_map_keyframe[keyframe], kExact, kExact));
}

TEST_F(KeyframeChainTest, ApproachesTheNextKeyframeAsClosely) {
  fly(11, 10);
  // What dead reckoning missed on the way is 0.2 m and 0.1 rad in all; from the last scan there, a tenth.
  const Pose2 T_0_1 =
      between(T_odom_keyframes_[KeyframeId{0}], T_odom_keyframes_[KeyframeId{1}]) * Pose2(0.2, 0.0, 0.1);
  const KeyframePoses T_map_keyframe({Pose2(), T_0_1});
  const Pose2 expected_step = between(scans_[ScanId{9}].T_odom_body, scans_[ScanId{10}].T_odom_body);
  const Pose2 step =
      between(chain_.T_w_body(ScanId{9}, T_map_keyframe), chain_.T_w_body(ScanId{10}, T_map_keyframe));
  EXPECT_TRUE(poses_near(step, expected_step, 0.05, 0.011));
}

TEST_F(KeyframeChainTest, EqualsDeadReckoningWhereTheKeyframesAgreeWithIt) {
  fly(31, 10);
  for (const auto& [id, scan] : scans_.all())
    EXPECT_TRUE(poses_near(chain_.T_w_body(id, T_odom_keyframes_), scan.T_odom_body, kExact, kExact));
}

TEST_F(KeyframeChainTest, SpreadsTheCorrectionEvenly) {
  fly(11, 10);
  const Pose2 missed(0.5, -0.3, 0.2);
  const KeyframePoses T_odom_moved(
      {T_odom_keyframes_[KeyframeId{0}], T_odom_keyframes_[KeyframeId{1}] * missed});
  for (const auto& [id, scan] : scans_.all()) {
    const double share = index_of(id) / 10.0;
    const Pose2 correction = between(scan.T_odom_body, chain_.T_w_body(id, T_odom_moved));
    EXPECT_TRUE(poses_near(correction, Pose2(share * 0.5, share * -0.3, share * 0.2), kExact, kExact))
        << index_of(id);
  }
}

TEST_F(KeyframeChainTest, ScansAfterTheLastKeyframeFollowByDeadReckoning) {
  fly(16, 10);
  const Pose2 T_map_odom(3.0, 4.0, 1.0);
  const KeyframePoses T_map_keyframe(
      {T_map_odom * T_odom_keyframes_[KeyframeId{0}], T_map_odom * T_odom_keyframes_[KeyframeId{1}]});
  for (ScanId i{10}; i < ScanId{16}; ++i)
    EXPECT_TRUE(
        poses_near(chain_.T_w_body(i, T_map_keyframe), T_map_odom * scans_[i].T_odom_body, kExact, kExact));
}

TEST_F(KeyframeChainTest, ThePastAloneCanBePlaced) {
  fly(31, 10);
  // A snapshot from when there were two keyframes.
  const KeyframePoses T_odom_early({T_odom_keyframes_[KeyframeId{0}], T_odom_keyframes_[KeyframeId{1}]});
  for (ScanId i{0}; i < ScanId{20}; ++i)
    EXPECT_TRUE(poses_near(chain_.T_w_body(i, T_odom_early), scans_[i].T_odom_body, kExact, kExact));
}

TEST_F(KeyframeChainTest, PlacesManyScansAsItPlacesEach) {
  fly(45, 10, 20);
  std::mt19937 random(43);
  KeyframePoses T_map_keyframe;
  for (std::size_t k = 0; k < chain_.size(); ++k) T_map_keyframe.push_back(random_pose(random, 5.0));
  for (const ScanRange& scans : {ScanRange{ScanId{0}, ScanId{45}}, ScanRange{ScanId{7}, ScanId{33}},
                                 ScanRange{ScanId{42}, ScanId{45}}, ScanRange{ScanId{5}, ScanId{5}}}) {
    for (const std::uint32_t every : {1U, 3U, 12U}) {
      const std::vector<Pose2> poses = chain_.T_w_bodies(scans, T_map_keyframe, every);
      ASSERT_EQ(poses.size(), (scans.end - scans.first + every - 1) / every);
      ScanId i = scans.first;
      for (const Pose2& pose : poses) {
        EXPECT_TRUE(poses_near(pose, chain_.T_w_body(i, T_map_keyframe), 0.0, 0.0)) << index_of(i);
        i = i + every;
      }
    }
  }
}

TEST_F(KeyframeChainTest, DoesNotBridgeIntoANewSegment) {
  fly(21, 10, 10);
  // Wherever the next segment is put, the scans before it stay with their own keyframe.
  const KeyframePoses T_odom_moved(
      {T_odom_keyframes_[KeyframeId{0}], Pose2(50.0, 60.0, 3.0), Pose2(51.0, 60.0, 3.0)});
  for (ScanId i{0}; i < ScanId{10}; ++i)
    EXPECT_TRUE(poses_near(chain_.T_w_body(i, T_odom_moved), scans_[i].T_odom_body, kExact, kExact));
  EXPECT_TRUE(
      poses_near(chain_.T_w_body(ScanId{10}, T_odom_moved), T_odom_moved[KeyframeId{1}], kExact, kExact));
}

TEST_F(KeyframeChainTest, PlacesWhatIsLeftAsBeforeWhenSomeIsErased) {
  fly(50, 10);
  std::vector<Pose2> before;
  for (const auto& [id, scan] : scans_.all()) before.push_back(chain_.T_w_body(id, T_odom_keyframes_));
  IdRanges<ScanId> scans;
  scans.add({ScanId{10}, ScanId{30}});
  IdRanges<KeyframeId> keyframes;
  keyframes.add({KeyframeId{1}, KeyframeId{3}});
  scans_.erase(scans);
  chain_.erase(keyframes);
  T_odom_keyframes_.erase(keyframes);
  ASSERT_EQ(chain_.size(), 3U);
  EXPECT_EQ(chain_.scan_of(KeyframeId{3}), ScanId{30});
  EXPECT_EQ(chain_.scans_of({KeyframeId{0}, KeyframeId{3}}), (ScanRange{ScanId{0}, ScanId{30}}));
  for (const auto& [id, scan] : scans_.all())
    EXPECT_TRUE(poses_near(chain_.T_w_body(id, T_odom_keyframes_), before[index_of(id)], kExact, kExact))
        << index_of(id);
}

}  // namespace
}  // namespace swiftlet
