// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/building_axis_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <ostream>
#include <utility>

#include "core/backend/pose_graph/pose_graph_optimizer.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/squared.hpp"

namespace swiftlet {
namespace {

constexpr double kAxisSigmaRad = radians(2.5);
constexpr double kStepSigmaRad = radians(1);
constexpr double kDriftRad = radians(0.4);  // that each step does not know of

WallAxis axis_seen_at(double true_yaw_rad, double building_rad = 0.0) {
  return {wrap_axis(building_rad - true_yaw_rad), kAxisSigmaRad};
}

/// Flies around a square in a building whose walls run with the map, with dead reckoning that turns
/// unnoticed.
struct Flight {
  PoseGraph graph;
  BuildingAxisPrior hold;
  PoseGraphOptimizer optimizer{5.0, 20};
  double true_yaw_rad = 0.0;

  Flight() { graph.T_map_keyframe.push_back({}); }

  void step(bool sees_walls, double building_rad = 0.0) {
    const std::size_t count = graph.T_map_keyframe.size();
    const double turn_rad = count % 20 == 0 ? kPi / 2.0 : 0.0;
    true_yaw_rad += turn_rad;
    const Pose2 T(0.5, 0.0, turn_rad + kDriftRad);
    graph.factors.push_back({make_id<KeyframeId>(count - 1), make_id<KeyframeId>(count), T,
                             Eigen::Vector3d(1e4, 1e4, 1.0 / (kStepSigmaRad * kStepSigmaRad)).asDiagonal()});
    graph.T_map_keyframe.push_back(graph.T_map_keyframe.values().back() * T);
    since_rad2 += kStepSigmaRad * kStepSigmaRad;
    if (!sees_walls || count % 6 != 0) return;
    const std::size_t before = graph.headings.size();
    hold.add(make_id<KeyframeId>(count), axis_seen_at(true_yaw_rad, building_rad), since_rad2, graph);
    if (graph.headings.size() == before) return;
    since_rad2 = 0.0;
    hold.update(graph);
    ASSERT_TRUE(optimizer.optimize(graph));
  }

  [[nodiscard]] double yaw_error_rad() const {
    return std::abs(wrap_angle(graph.T_map_keyframe.values().back().yaw_rad() - true_yaw_rad));
  }
  /// How far the way is bent: the heading's error at the end against that after the first lap.
  [[nodiscard]] double bend_rad() const {
    const double after_a_lap_rad = graph.T_map_keyframe[make_id<KeyframeId>(80)].yaw_rad() - 4.0 * kPi / 2.0;
    return std::abs(
        wrap_angle(graph.T_map_keyframe.values().back().yaw_rad() - true_yaw_rad - after_a_lap_rad));
  }
  double since_rad2 = 0.0;
};

TEST(BuildingAxisPrior, KeepsTheHeadingAlongAWayThatDeadReckoningLosesItOn) {
  Flight flight;
  Flight without;
  for (int i = 0; i < 300; ++i) {
    flight.step(true);
    without.step(false);
  }
  EXPECT_GT(without.yaw_error_rad(), radians(110)) << "120 degrees of drift";
  EXPECT_LT(flight.bend_rad(), std::sqrt(3.0) * kAxisSigmaRad)
      << "a heading is good to that; of 88 degrees of drift";
  EXPECT_GT(without.bend_rad(), radians(80));
  EXPECT_EQ(flight.graph.headings.size(), 50U);
}

TEST(BuildingAxisPrior, KeepsTheHeadingInAWingThatStandsAskewByItsOwnAxis) {
  Flight flight;
  for (int i = 0; i < 60; ++i) flight.step(true);
  const double before_rad = flight.yaw_error_rad();
  for (int lap = 0; lap < 3; ++lap) {
    for (int i = 0; i < 42; ++i) flight.step(true, radians(40));
    for (int i = 0; i < 42; ++i) flight.step(true);
  }
  EXPECT_LT(flight.yaw_error_rad(), before_rad + radians(12)) << "of 100 degrees of drift";
}

/// Degrees to the building's axis, and the variance, deg², of what the vehicle may have turned since the last
/// heading factor.
using Seen = std::pair<double, double>;

/// Votes by the axis that they hold to.
struct Held {
  std::size_t first = 0;
  std::size_t another = 0;
  friend bool operator==(const Held&, const Held&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Held& held) {
    return out << held.first << " by the first, " << held.another << " by another";
  }
};

/// What a vehicle that does not turn holds to by seeing these walls where so many votes hold the first axis.
Held held_by(std::initializer_list<Seen> walls, std::size_t first_votes = 30) {
  PoseGraph graph;
  BuildingAxisPrior hold;
  std::size_t keyframe = 0;
  const auto see = [&](const Seen& seen) {
    graph.T_map_keyframe.push_back({});
    hold.add(make_id<KeyframeId>(keyframe++), axis_seen_at(0.0, radians(seen.first)),
             squared(radians(1.0)) * seen.second, graph);
  };
  for (std::size_t i = 0; i < first_votes; ++i) see({0.0, 0.0});
  for (const Seen& seen : walls) see(seen);
  hold.update(graph);
  Held held;
  for (std::size_t i = first_votes; i < graph.headings.size(); ++i) {
    const HeadingFactor<KeyframeId>& heading = graph.headings[i];
    const std::size_t vote = index_of(heading.pose) - first_votes;
    // Turned back by most of what its walls are off the first axis, or left about where it is.
    const bool is_turned =
        std::abs(heading.yaw_map_rad) > radians(std::abs((walls.begin() + vote)->first)) / 2.0;
    ++(is_turned ? held.first : held.another);
  }
  return held;
}

TEST(BuildingAxisPrior, WallsFartherOffThanASlipTurnsHaveAnAxisOfTheirOwn) {
  EXPECT_EQ(held_by({{40, 4}, {41, 5}}), Held()) << "both may see the same piece of furniture";
  EXPECT_EQ(held_by({{40, 4}, {41, 5}, {39, 6}}), (Held{.another = 3}));
  EXPECT_EQ(held_by({{20, 16}, {21, 17}, {22, 18}}), (Held{.first = 3})) << "a slip of 20 degrees";
  EXPECT_EQ(held_by({{40, 4}, {10, 5}, {39, 6}}), (Held{.first = 1})) << "10 degrees belong to the first";
}

TEST(BuildingAxisPrior, AVoteThatGoesOnWithWallsOfAnotherAxisIsNotOneForTheFirst) {
  EXPECT_EQ(held_by({{12, 9}}), (Held{.first = 1}));
  EXPECT_EQ(held_by({{20, 4}, {12, 9}}), Held()) << "near enough alone, as the motion since has grown";
  EXPECT_EQ(held_by({{20, 4}, {12, 9}, {20, 10}}), (Held{.another = 3}));
}

TEST(BuildingAxisPrior, WallsThatHoldToNoAxisMakeAnotherLikelierForTheNext) {
  EXPECT_EQ(held_by({{15, 4}}), (Held{.first = 1})) << "a slip of 15 degrees";
  EXPECT_EQ(held_by({{40, 4}, {-20, 4}, {30, 4}, {-40, 4}, {15, 4}}), Held()) << "walls stand anywhere here";
}

TEST(BuildingAxisPrior, WhatIsTurnedUnnoticedOnTheWayToAnotherAxisIsSoOnTheWayBack) {
  EXPECT_EQ(held_by({{14, 0}}), Held()) << "without motion since the last vote";
  EXPECT_EQ(held_by({{40, 4}, {41, 5}, {39, 6}, {14, 0}}), (Held{.first = 1, .another = 3}));
}

TEST(BuildingAxisPrior, AVoteThatTheMapHasNotFollowedYetSpeaksForTheNextThatIsOffAsMuch) {
  EXPECT_EQ(held_by({{15, 4}, {15, 0}}), (Held{.first = 2}));
}

TEST(BuildingAxisPrior, TurnsNobodyBackWhoMayHaveLostMoreThanItCanTell) {
  Flight flight;
  for (int i = 0; i < 60; ++i) flight.step(true);
  const double yaw_rad = flight.graph.T_map_keyframe.values().back().yaw_rad();
  const std::size_t before = flight.graph.headings.size();
  flight.hold.add(make_id<KeyframeId>(60), axis_seen_at(yaw_rad, radians(42)), radians(90) * radians(90),
                  flight.graph);
  EXPECT_EQ(flight.graph.headings.size(), before);
}

TEST(BuildingAxisPrior, TurnsBackAsFarAsTheOtherWayRoundIsMuchLessLikely) {
  EXPECT_EQ(held_by({{34, 81}}), (Held{.first = 1})) << "after a spin; the other way round it were 56";
  EXPECT_EQ(held_by({{34, 25}}), Held()) << "farther than can be believed";
  EXPECT_EQ(held_by({{34, 324}}), Held()) << "the other way round is no wonder either";
  EXPECT_EQ(held_by({{16, 324}}), (Held{.first = 1}));
}

TEST(BuildingAxisPrior, TurnsBackTheLessTheFewerVotesHoldTheAxis) {
  EXPECT_EQ(held_by({{34, 81}}, 3), Held());
  EXPECT_EQ(held_by({{19, 81}}, 3), (Held{.first = 1}));
}

TEST(BuildingAxisPrior, AFalseAxisIsScaledAwayByTheOthers) {
  Flight flight;
  for (int i = 0; i < 120; ++i) flight.step(true);
  const std::size_t wrong = flight.graph.headings.size();
  flight.hold.add(make_id<KeyframeId>(120), axis_seen_at(flight.true_yaw_rad, radians(22)),
                  radians(9) * radians(9), flight.graph);
  ASSERT_EQ(flight.graph.headings.size(), wrong + 1);
  for (int i = 0; i < 60; ++i) flight.step(true);
  EXPECT_LT(flight.graph.headings[wrong].dcs_scale, 0.7);
  EXPECT_LT(flight.bend_rad(), std::sqrt(3.0) * kAxisSigmaRad);
}

TEST(BuildingAxisPrior, HeadingsOfKeyframesThatAreErasedGoWithThem) {
  Flight flight;
  for (int i = 0; i < 60; ++i) flight.step(true);
  ASSERT_EQ(flight.graph.headings.size(), 10U);
  IdRanges<KeyframeId> gone;
  gone.add({make_id<KeyframeId>(10), make_id<KeyframeId>(25)});  // and with it the headings of 12, 18 and 24
  flight.graph.T_map_keyframe.erase(gone);
  flight.hold.erase(gone, flight.graph);
  ASSERT_EQ(flight.graph.headings.size(), 7U);
  EXPECT_EQ(flight.graph.headings[0].pose, make_id<KeyframeId>(6));
  EXPECT_EQ(flight.graph.headings[1].pose, make_id<KeyframeId>(30));
  flight.hold.update(flight.graph);
  for (const HeadingFactor<KeyframeId>& heading : flight.graph.headings) {
    const double now_rad = flight.graph.T_map_keyframe[heading.pose].yaw_rad();
    EXPECT_NEAR(wrap_angle(heading.yaw_map_rad - now_rad), 0.0, radians(5)) << "each says what it said";
  }
}

/// Votes of a vehicle that keeps its heading, of which some are erased.
struct ForgottenVotes {
  /// Whether the vote adds headings.
  bool add(double deg) {
    const std::size_t before = graph.headings.size();
    graph.T_map_keyframe.push_back({});
    hold.add(graph.T_map_keyframe.last_id(), axis_seen_at(0.0, radians(deg)), squared(radians(2.0)), graph);
    return graph.headings.size() > before;
  }
  void erase(std::size_t first, std::size_t end) {
    IdRanges<KeyframeId> gone;
    gone.add({make_id<KeyframeId>(first), make_id<KeyframeId>(end)});
    graph.T_map_keyframe.erase(gone);
    hold.erase(gone, graph);
  }
  PoseGraph graph;
  BuildingAxisPrior hold;
};

TEST(BuildingAxisPrior, WhereVotesAreErasedTheOthersAreAsManyInProportion) {
  for (const double deg : {11.0, 12.0}) {
    ForgottenVotes votes;
    for (int i = 0; i < 60; ++i) EXPECT_TRUE(votes.add(0));
    for (const double elsewhere_deg : {40.0, -20.0, 30.0, -40.0}) EXPECT_FALSE(votes.add(elsewhere_deg));
    EXPECT_TRUE(votes.add(0));
    votes.erase(10, 60);
    ASSERT_EQ(votes.graph.headings.size(), 11U);
    EXPECT_EQ(votes.add(deg), deg < 11.5)
        << "nearly all votes hold to the first axis, as before, but not all";
  }
}

TEST(BuildingAxisPrior, WhatIsErasedBetweenVotesForANewAxisLeavesTheOldOneItsWeight) {
  ForgottenVotes votes;
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(votes.add(0));
  EXPECT_FALSE(votes.add(40));
  votes.erase(10, 13);
  EXPECT_FALSE(votes.add(40));
  votes.erase(13, 16);
  EXPECT_TRUE(votes.add(40)) << "three votes make an axis";
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(votes.add(0));
}

TEST(BuildingAxisPrior, AnAxisOfWhichNoHeadingIsLeftIsForgotten) {
  PoseGraph graph;
  BuildingAxisPrior hold;
  const auto see = [&](double deg, double deg2) {
    graph.T_map_keyframe.push_back({});
    hold.add(graph.T_map_keyframe.last_id(), axis_seen_at(0.0, radians(deg)), squared(radians(1.0)) * deg2,
             graph);
  };
  see(40, 0);
  for (const double deg2 : {1.0, 2.0, 3.0}) see(-3, deg2);
  ASSERT_EQ(graph.headings.size(), 4U) << "a second axis";
  IdRanges<KeyframeId> gone;
  gone.add({make_id<KeyframeId>(1), make_id<KeyframeId>(4)});
  graph.T_map_keyframe.erase(gone);
  hold.erase(gone, graph);
  ASSERT_EQ(graph.headings.size(), 1U);
  for (const double deg2 : {1.0, 2.0, 3.0}) see(0, deg2);
  EXPECT_EQ(graph.headings.size(), 4U) << "far off the first axis, and off no other";
}

}  // namespace
}  // namespace swiftlet
