// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/relation_error.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Optional;

/// One pose a second, one metre further along x each.
StampedPath straight_path(int last_second) {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= last_second; ++i) poses.push_back({HostTime(seconds(i)), Pose2(i, 0.0, 0.0)});
  return StampedPath(std::move(poses));
}

/// True motion along the straight path, wrong by so much.
Relation relation(int first, int second, double wrong_m, double wrong_deg) {
  return {HostTime(seconds(first)), HostTime(seconds(second)),
          Pose2(second - first, wrong_m, radians(wrong_deg))};
}

TEST(RelationError, IsMeanDeviationAndMaximumWhateverTheMapsFrame) {
  // Estimated: 1 m ahead, a quarter turn, 1 m ahead. True: each of the steps differs but the last.
  const std::vector<HostTime> stamps{HostTime(seconds(1)), HostTime(seconds(2)), HostTime(seconds(3))};
  const std::vector<Relation> relations{{stamps[0], stamps[1], Pose2(1.3, 0.4, kPi / 2.0)},
                                        {stamps[1], stamps[2], Pose2(1.0, 0.0, radians(-3.0))},
                                        {stamps[2], stamps[0], Pose2(-1.0, 1.0, -kPi / 2.0)}};
  for (const Pose2& T_map_start : {Pose2(), Pose2(5.0, -7.0, 3.0)}) {
    const Pose2 T_map_second = T_map_start * Pose2(1.0, 0.0, kPi / 2.0);
    const StampedPath path({{stamps[0], T_map_start},
                            {stamps[1], T_map_second},
                            {stamps[2], T_map_second * Pose2(1.0, 0.0, 0.0)}});
    const RelationError error = relation_error(relations, path);
    EXPECT_EQ(error.all.count, 3U);
    EXPECT_EQ(error.missed, 0U);
    EXPECT_THAT(error.each_translation_m,
                ElementsAre(Optional(DoubleNear(0.5, 1e-9)), Optional(DoubleNear(0.0, 1e-9)),
                            Optional(DoubleNear(0.0, 1e-9))));
    EXPECT_NEAR(error.all.translation_m.mean, 0.5 / 3.0, 1e-9);
    EXPECT_NEAR(error.all.translation_m.deviation, 0.5 * std::sqrt(2.0) / 3.0, 1e-9);
    EXPECT_NEAR(error.all.translation_m.max, 0.5, 1e-9);
    EXPECT_NEAR(error.all.rotation_deg.mean, 1.0, 1e-9);
    EXPECT_NEAR(error.all.rotation_deg.deviation, std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(error.all.rotation_deg.max, 3.0, 1e-9);
  }
}

TEST(RelationError, IsSplitByTheTimeBetweenTheStampsWhicheverComesFirst) {
  const std::vector<Relation> relations{relation(0, 2, 0.1, 1.0),     relation(7, 5, 0.3, 3.0),
                                        relation(0, 3, 0.5, 5.0),     relation(99, 0, 0.5, 5.0),
                                        relation(10, 110, 0.7, 12.0), relation(200, 0, 0.9, 13.0)};
  const RelationError error = relation_error(relations, straight_path(200));
  EXPECT_EQ(error.all.count, 6U);
  EXPECT_EQ(error.under_3_s.count, 2U);
  EXPECT_NEAR(error.under_3_s.translation_m.mean, 0.2, 1e-9);
  EXPECT_NEAR(error.under_3_s.rotation_deg.max, 3.0, 1e-9);
  EXPECT_EQ(error.from_3_to_100_s.count, 2U);
  EXPECT_NEAR(error.from_3_to_100_s.translation_m.mean, 0.5, 1e-9);
  EXPECT_NEAR(error.from_3_to_100_s.translation_m.deviation, 0.0, 1e-9);
  EXPECT_EQ(error.over_100_s.count, 2U);
  EXPECT_NEAR(error.over_100_s.rotation_deg.mean, 12.5, 1e-9);
  EXPECT_NEAR(error.over_100_s.rotation_deg.deviation, 0.5, 1e-9);
}

TEST(RelationError, NamesEachStampWithoutPoseOnceAndLeavesItsRelationsOut) {
  const std::vector<Relation> relations{relation(0, 1, 0.1, 0.0), relation(1, 9, 5.0, 0.0),
                                        relation(9, 2, 5.0, 0.0), relation(7, 9, 5.0, 0.0)};
  const RelationError error = relation_error(relations, straight_path(3));
  EXPECT_EQ(error.all.count, 1U);
  EXPECT_NEAR(error.all.translation_m.max, 0.1, 1e-9);
  EXPECT_EQ(error.missed, 3U);
  EXPECT_THAT(error.each_translation_m,
              ElementsAre(Optional(DoubleNear(0.1, 1e-9)), std::nullopt, std::nullopt, std::nullopt));
  EXPECT_EQ(error.stamps.exact, 3U);
  EXPECT_THAT(error.stamps.unmatched, ElementsAre(HostTime(seconds(7)), HostTime(seconds(9))));
}

TEST(RelationError, TakesThePoseStampedNearest) {
  const StampedPath path({{HostTime(seconds(1)), Pose2()},
                          {HostTime(seconds(1) + milliseconds(2)), Pose2(1.0, 0.0, 0.0)},
                          {HostTime(seconds(2)), Pose2(2.0, 0.0, 0.0)}});
  const auto mean_from = [&](HostTime first) {
    const std::vector<Relation> one{{first, HostTime(seconds(2)), Pose2(1.0, 0.0, 0.0)}};
    return relation_error(one, path).all.translation_m.mean;
  };
  EXPECT_EQ(mean_from(HostTime(seconds(1) + microseconds(1'400))), 0.0);
  EXPECT_EQ(mean_from(HostTime(seconds(1) + microseconds(600))), 1.0);
}

TEST(RelationError, OfAPathWithoutPosesMissesAll) {
  const std::vector<Relation> one{relation(0, 1, 0.0, 0.0)};
  const RelationError error = relation_error(one, StampedPath({}));
  EXPECT_EQ(error.missed, 1U);
  EXPECT_EQ(error.all.count, 0U);
  EXPECT_EQ(error.all.translation_m.mean, 0.0);
}

}  // namespace
}  // namespace swiftlet
