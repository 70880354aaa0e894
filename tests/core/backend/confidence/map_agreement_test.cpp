// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/map_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/backend/loop_closing/max_filter.hpp"
#include "tests/support/drawn_submap.hpp"

namespace swiftlet {
namespace {

constexpr double kLongAgoM = 1000.0;

/// A room of 6 m by 6 m with walls of 0.2 m, seen free inside, and unknown ground around it.
Submap room() {
  std::vector<std::string> picture(70, std::string(70, ' '));
  for (std::size_t row = 5; row < 65; ++row)
    for (std::size_t column = 5; column < 65; ++column)
      picture[row][column] = row < 7 || row >= 63 || column < 7 || column >= 63 ? '#' : '.';
  return drawn_submap(picture, 0.1, 1);
}

/// So many beams to each of four walls.
BeamLayout beams_to_walls(std::size_t of_each) {
  const BeamLayout each = BeamLayout::multiranger();
  BeamLayout beams;
  beams.count = static_cast<std::uint8_t>(each.count * of_each);
  for (std::size_t i = 0; i < beams.count; ++i) beams.bearing_rad[i] = each.bearing_rad[i % each.count];
  return beams;
}

/// A vehicle that sees the four walls of the room from where it is, held for elsewhere.
class MapAgreementTest : public testing::Test {
 protected:
  explicit MapAgreementTest(std::size_t beams_to_wall = 1) : scans_(beams_to_walls(beams_to_wall)) {
    beam_count_ = beams_to_walls(beams_to_wall).count;
    T_map_keyframe_.push_back(Pose2());
    submaps_.push_back(std::make_shared<const Submap>(room()));
  }

  /// One scan from `at`, of which the program thinks that it was made from `off` further on.
  void see(const Point2& at, const Point2& off) {
    constexpr double kWallM = 2.9;
    FrontendStep step;
    RangeSample& sample = step.sample;
    sample.T_odom_body = Pose2(at.x_m, at.y_m, 0.0);
    sample.beam_count = beam_count_;
    const double distances[] = {kWallM - at.x_m, kWallM - at.y_m, kWallM + at.x_m, kWallM + at.y_m};
    for (std::size_t i = 0; i < beam_count_; ++i) {
      sample.distance_m[i] = static_cast<float>(distances[i % 4]);
      sample.status[i] = RangeStatus::kHit;
    }
    scans_.add(step);
    const Pose2 T_map_body(at.x_m + off.x_m, at.y_m + off.y_m, 0.0);
    agreement_.look_around(T_map_body, kLongAgoM, {}, submaps_, T_map_keyframe_);
    agreement_.add_newest_scan(T_map_body);
  }
  [[nodiscard]] double of_two_contradictions_in_four() const {
    const double right = tuning_.share_if_right;
    const double off = tuning_.share_if_off;
    return 2.0 * std::log(off * (1.0 - off) / (right * (1.0 - right))) / tuning_.alarm_log_odds;
  }
  /// To and fro along the room.
  void fly(int scans, const Point2& off) {
    for (int i = 0; i < scans; ++i) see({std::sin(0.3 * i), 0.4 * std::cos(0.2 * i)}, off);
  }

  ConfidenceTuning tuning_;
  std::uint8_t beam_count_ = 0;
  ScanStore scans_;
  KeyframePoses T_map_keyframe_;
  std::vector<std::shared_ptr<const Submap>> submaps_;
  MapAgreement agreement_{tuning_, scans_};
};

TEST_F(MapAgreementTest, ARightPoseIsNeverContradicted) {
  fly(500, {0.0, 0.0});
  EXPECT_GT(agreement_.returns_compared(), 1000U);
  EXPECT_EQ(agreement_.contradiction(), 0.0);
  EXPECT_EQ(agreement_.times_contradicted(), 0U);
}

TEST_F(MapAgreementTest, APoseOffByLessThanTheToleranceIsNotContradicted) {
  fly(500, {0.2, -0.15});
  EXPECT_EQ(agreement_.contradicting_share(), 0.0);
}

TEST_F(MapAgreementTest, APoseOffByAMetreIsContradictedWithinTwoMetresOfTravel) {
  int scans = 0;
  while (!agreement_.is_contradicted() && scans < 500) see({0.1 * (++scans % 10), 0.0}, {1.0, 0.5});
  EXPECT_LE(scans, 20);
  EXPECT_GT(agreement_.contradicting_share(), 0.1);
}

TEST_F(MapAgreementTest, BeamsThatEndInTheOpenAndBeamsThroughWallsBothContradict) {
  see({0.0, 0.0}, {1.0, 0.0});
  // Ahead through the wall, behind in the open; left and right on walls still.
  EXPECT_EQ(agreement_.returns_compared(), 4U);
  EXPECT_NEAR(agreement_.contradicting_share(), 2.0 / tuning_.recent_returns, 0.005);
}

TEST_F(MapAgreementTest, TellsWhereAReturnAgreedLast) {
  EXPECT_EQ(agreement_.agreed_at_m(), 0.0);
  see({0.0, 0.0}, {0.0, 0.0});
  see({0.5, 0.0}, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(agreement_.agreed_at_m(), 0.5);
  see({1.0, 0.0}, {50.0, 0.0});
  EXPECT_DOUBLE_EQ(agreement_.agreed_at_m(), 0.5) << "no older map there";
  see({1.5, 0.0}, {0.9, 0.9});
  EXPECT_DOUBLE_EQ(agreement_.agreed_at_m(), 0.5) << "all four contradict it";
}

TEST_F(MapAgreementTest, EachReturnOfFourCountsInFull) {
  see({0.0, 0.0}, {1.0, 0.0});
  EXPECT_NEAR(agreement_.contradiction(), of_two_contradictions_in_four(), 1e-9);
}

class MapAgreementOfManyBeams : public MapAgreementTest {
 protected:
  MapAgreementOfManyBeams() : MapAgreementTest(8) {}
};

TEST_F(MapAgreementOfManyBeams, ReturnsOfOneScanCountAsFour) {
  see({0.0, 0.0}, {1.0, 0.0});
  EXPECT_EQ(agreement_.returns_compared(), 32U);
  EXPECT_NEAR(agreement_.contradiction(), of_two_contradictions_in_four(), 1e-9);
}

TEST_F(MapAgreementTest, WhoeverHoversIsComparedOnce) {
  for (int i = 0; i < 100; ++i) see({0.5, 0.5}, {1.0, 1.0});
  EXPECT_EQ(agreement_.returns_compared(), 4U);
}

TEST_F(MapAgreementTest, GroundThatWasJustFlownSaysNothing) {
  submaps_.clear();
  Submap newest = room();
  newest.end_path_m = kLongAgoM - 1.0;
  submaps_.push_back(std::make_shared<const Submap>(newest));
  fly(100, {1.0, 0.5});
  EXPECT_EQ(agreement_.returns_compared(), 0U);
}

TEST_F(MapAgreementTest, WhatStandsOnAnotherStoreySaysNothing) {
  Submap above = *submaps_.front();
  above.storey = StoreyId{1};
  submaps_ = {std::make_shared<const Submap>(above)};
  fly(100, {1.0, 0.5});
  EXPECT_EQ(agreement_.returns_compared(), 0U);
}

TEST_F(MapAgreementTest, TheStateHoldsUntilTheEvidenceIsGone) {
  fly(100, {1.0, 0.5});
  ASSERT_TRUE(agreement_.is_contradicted());
  fly(5, {0.0, 0.0});
  EXPECT_TRUE(agreement_.is_contradicted());
  fly(200, {0.0, 0.0});
  EXPECT_FALSE(agreement_.is_contradicted());
  EXPECT_EQ(agreement_.times_contradicted(), 1U);
}

TEST_F(MapAgreementTest, ACorrectedPoseBeginsAgain) {
  fly(100, {1.0, 0.5});
  agreement_.begin_again();
  EXPECT_FALSE(agreement_.is_contradicted());
  EXPECT_EQ(agreement_.contradiction(), 0.0);
  fly(100, {1.0, 0.5});
  EXPECT_EQ(agreement_.times_contradicted(), 2U);
}

}  // namespace
}  // namespace swiftlet
