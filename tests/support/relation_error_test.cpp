// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/relation_error.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

HostTime at(Duration since_epoch) { return HostTime(since_epoch); }

TEST(ReadRelations, TakesTimesPositionAndYaw) {
  std::istringstream lines("90.239599 90.719599 0.42 -0.01 0 0 0 0.5\n\n1 2 3 4 0 0 0 -0.5\n");
  const std::vector<Relation> relations = read_relations(lines);
  ASSERT_EQ(relations.size(), 2U);
  EXPECT_EQ(relations[0].first, at(microseconds(90'239'599)));
  EXPECT_EQ(relations[0].second, at(microseconds(90'719'599)));
  EXPECT_EQ(relations[0].T_first_second.vector(), Eigen::Vector3d(0.42, -0.01, 0.5));
  EXPECT_EQ(relations[1].T_first_second.vector(), Eigen::Vector3d(3.0, 4.0, -0.5));
}

TEST(RelationError, IsTheMeanOverTheRelationsWhateverTheMapsFrame) {
  // Estimated: 1 m ahead, a quarter turn, 1 m ahead. True: each of the two steps differs.
  const std::vector<HostTime> stamps{at(seconds(1)), at(seconds(2)), at(seconds(3))};
  const std::vector<Relation> relations{{stamps[0], stamps[1], Pose2(1.3, 0.4, kPi / 2.0)},
                                        {stamps[1], stamps[2], Pose2(1.0, 0.0, radians(-3.0))},
                                        {stamps[2], stamps[0], Pose2(-1.0, 1.0, -kPi / 2.0)}};
  for (const Pose2& T_map_start : {Pose2(), Pose2(5.0, -7.0, 3.0)}) {
    std::vector<Pose2> T_map_body{T_map_start};
    T_map_body.push_back(T_map_start * Pose2(1.0, 0.0, kPi / 2.0));
    T_map_body.push_back(T_map_body[1] * Pose2(1.0, 0.0, 0.0));
    const RelationError error = relation_error(relations, stamps, T_map_body);
    EXPECT_EQ(error.matched, 3U);
    EXPECT_EQ(error.missed, 0U);
    EXPECT_NEAR(error.mean_m, 0.5 / 3.0, 1e-9);
    EXPECT_NEAR(error.mean_deg, 3.0 / 3.0, 1e-9);
  }
}

TEST(RelationError, TakesTheNearestStampWithinTwoMilliseconds) {
  const std::vector<HostTime> stamps{at(seconds(1)), at(seconds(1) + milliseconds(2)), at(seconds(2))};
  const std::vector<Pose2> T_map_body{Pose2(), Pose2(1.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.0)};
  const auto error_from = [&](HostTime first) {
    const Relation relation{first, stamps[2], Pose2(1.0, 0.0, 0.0)};
    return relation_error(std::vector<Relation>{relation}, stamps, T_map_body);
  };
  EXPECT_EQ(error_from(at(seconds(1) + microseconds(1'400))).mean_m, 0.0);
  EXPECT_EQ(error_from(at(seconds(1) + microseconds(600))).mean_m, 1.0);
  EXPECT_EQ(error_from(at(seconds(1) + microseconds(4'100))).missed, 1U);
  EXPECT_EQ(error_from(at(seconds(1) - microseconds(2'100))).missed, 1U);
  EXPECT_EQ(error_from(at(seconds(9))).missed, 1U);
}

TEST(RelationError, WithoutPosesAllIsMissed) {
  const Relation relation{at(seconds(1)), at(seconds(2)), Pose2()};
  const RelationError error = relation_error(std::vector<Relation>{relation}, {}, {});
  EXPECT_EQ(error.missed, 1U);
  EXPECT_EQ(error.matched, 0U);
  EXPECT_EQ(error.mean_m, 0.0);
}

}  // namespace
}  // namespace swiftlet
