// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/storey_tracker.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <random>
#include <vector>

namespace swiftlet {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kSampleS = 0.1;
constexpr double kNoiseM = 0.1;
constexpr double kStoreyM = 3.0;
constexpr double kLowestStoreyM = 2.5;

/// Feeds readings of a barometer.
class StoreyTrackerTest : public testing::Test {
 protected:
  /// The ground changes evenly, by nothing for level flight.
  void fly(double seconds, double rises_m = 0.0) {
    const int count = static_cast<int>(seconds / kSampleS);
    for (int i = 0; i < count; ++i) {
      ground_m_ += rises_m / count;
      at_ += from_seconds(kSampleS);
      tracker_.add(at_, ground_m_ + noise_(random_));
    }
  }
  [[nodiscard]] std::size_t storey() const { return index_of(tracker_.current()); }
  [[nodiscard]] std::vector<double> known_levels_m() const {
    std::vector<double> levels_m;
    for (const StoreyLevel& level : tracker_.levels())
      if (level.is_known) levels_m.push_back(level.above_first_m);
    return levels_m;
  }
  void weather(double seconds, double m_per_s, double rises_m = 0.0) {
    fly(seconds, rises_m + m_per_s * seconds);
  }

  StoreyTracker tracker_;
  double ground_m_ = 123.0;

 private:
  std::mt19937 random_{1};
  std::normal_distribution<double> noise_{0.0, kNoiseM};
  DeviceTime at_{};
};

TEST_F(StoreyTrackerTest, IsOnTheFirstStoreyWhereNothingIsKnown) {
  EXPECT_EQ(storey(), 0U);
  EXPECT_THAT(known_levels_m(), ElementsAre(0.0));
}

TEST_F(StoreyTrackerTest, StairsLeadToAnotherStoreyAndBackToTheFirst) {
  fly(60.0);
  fly(20.0, kStoreyM);
  EXPECT_EQ(storey(), 1U);
  fly(60.0);
  EXPECT_EQ(storey(), 1U);
  fly(20.0, -kStoreyM);
  fly(60.0);
  EXPECT_EQ(storey(), 0U);
  EXPECT_THAT(known_levels_m(), ElementsAre(0.0, DoubleNear(kStoreyM, 0.3)));
}

TEST_F(StoreyTrackerTest, ASlowClimbOfTheLowestStoreyIsOneToo) {
  fly(60.0);
  fly(60.0, kLowestStoreyM);
  EXPECT_EQ(storey(), 1U);
}

TEST_F(StoreyTrackerTest, EachOfSeveralIsKnownAgain) {
  fly(30.0);
  for (int i = 0; i < 3; ++i) {
    fly(20.0, kStoreyM);
    fly(40.0);
  }
  EXPECT_EQ(storey(), 3U);
  for (const std::size_t below : {2U, 1U, 0U}) {
    fly(20.0, -kStoreyM);
    fly(40.0);
    EXPECT_EQ(storey(), below);
  }
  fly(30.0, 2.0 * kStoreyM);
  fly(40.0);
  EXPECT_EQ(storey(), 2U);
  fly(30.0, -3.0 * kStoreyM);
  fly(40.0);
  EXPECT_EQ(storey(), 4U) << "the cellar";
  EXPECT_EQ(tracker_.levels().size(), 5U);
}

TEST_F(StoreyTrackerTest, AHighStoreyIsReachedWhereTheClimbEnds) {
  fly(30.0);
  fly(60.0, 5.5);
  fly(60.0);
  EXPECT_EQ(storey(), 1U);
  fly(60.0, -5.5);
  fly(60.0);
  EXPECT_EQ(storey(), 0U);
  EXPECT_EQ(tracker_.levels().size(), 2U) << "there is none half way";
  EXPECT_THAT(known_levels_m(), ElementsAre(0.0, DoubleNear(5.5, 0.4)));
}

TEST_F(StoreyTrackerTest, WhoTurnsBackOnTheStairsIsWhereHeWas) {
  fly(30.0);
  fly(15.0, 2.3);
  EXPECT_EQ(storey(), 1U) << "on the stairs";
  fly(15.0, -2.3);
  fly(30.0);
  EXPECT_EQ(storey(), 0U);
  fly(20.0, kStoreyM);
  fly(30.0);
  EXPECT_EQ(storey(), 1U) << "what was seen on the stairs belongs to it";
}

TEST_F(StoreyTrackerTest, AClimbThatWasGivenUpIsNotTheCellar) {
  fly(30.0);
  fly(15.0, 2.3);
  fly(15.0, -2.3);
  fly(30.0);
  fly(20.0, -kStoreyM);
  fly(30.0);
  EXPECT_EQ(storey(), 2U);
  EXPECT_THAT(known_levels_m(), ElementsAre(0.0, DoubleNear(-kStoreyM, 0.3)));
}

TEST_F(StoreyTrackerTest, AStoreyBetweenTwoIsFoundWhereTheClimbEnds) {
  fly(30.0);
  fly(20.0, 2.0 * kStoreyM);
  fly(30.0);
  fly(15.0, -kStoreyM);
  fly(30.0);
  EXPECT_EQ(storey(), 2U);
}

TEST_F(StoreyTrackerTest, NeitherWeatherNorTablesNorALandingOnTheStairsChangeIt) {
  fly(30.0);
  fly(600.0, 2.5);  // the pressure falls
  EXPECT_EQ(storey(), 0U);
  for (const double step_m : {0.75, -0.75, 1.1, -1.1}) {  // tables, sideboards
    fly(kSampleS, step_m);
    fly(20.0);
    EXPECT_EQ(storey(), 0U);
  }
  fly(10.0, 1.5);
  fly(20.0);
  EXPECT_EQ(storey(), 0U);
}

TEST_F(StoreyTrackerTest, AClimbEndsOverFurniture) {
  fly(30.0);
  fly(20.0, kStoreyM);
  for (int i = 0; i < 20; ++i) {  // a table every 12 s
    fly(kSampleS, 0.75);
    fly(6.0);
    fly(kSampleS, -0.75);
    fly(6.0);
  }
  EXPECT_EQ(storey(), 1U);
  fly(20.0, kStoreyM);
  fly(30.0);
  EXPECT_EQ(storey(), 2U) << "the next floor is not drawn onto it";
  fly(20.0, -kStoreyM);
  fly(30.0);
  EXPECT_EQ(storey(), 1U);
}

constexpr double kWeatherMPerS = 2.5 / 600.0;

TEST_F(StoreyTrackerTest, ASlowClimbAgainstTheWeatherIsOne) {
  weather(300.0, -kWeatherMPerS);
  weather(60.0, -kWeatherMPerS, kLowestStoreyM);
  EXPECT_EQ(storey(), 1U);
  weather(60.0, -kWeatherMPerS);
  weather(60.0, -kWeatherMPerS, -kLowestStoreyM);
  weather(60.0, -kWeatherMPerS);
  EXPECT_EQ(storey(), 0U);
}

TEST_F(StoreyTrackerTest, ALandingHalfWayUpWithTheWeatherIsNone) {
  weather(300.0, kWeatherMPerS);
  weather(10.0, kWeatherMPerS, 1.5);
  weather(20.0, kWeatherMPerS);
  EXPECT_EQ(storey(), 0U);
}

TEST_F(StoreyTrackerTest, BehindARestartTheGroundMayBeAnother) {
  fly(30.0);
  tracker_.restart();
  fly(20.0);
  EXPECT_EQ(storey(), 0U);
  tracker_.restart();
  ground_m_ += kStoreyM;
  fly(kSampleS);
  EXPECT_EQ(storey(), 0U) << "one reading decides nothing";
  fly(5.0);
  EXPECT_EQ(storey(), 1U);
  tracker_.restart();
  fly(20.0);
  EXPECT_EQ(known_levels_m().size(), 2U) << "a restart while it was new";
}

TEST_F(StoreyTrackerTest, MoreStoreysThanItCanHoldAreNoNewOnes) {
  for (std::size_t i = 0; i < kMaxStoreys + 3; ++i) {
    fly(20.0);
    fly(10.0, kStoreyM);
  }
  EXPECT_EQ(tracker_.levels().size(), kMaxStoreys);
  EXPECT_EQ(storey(), kMaxStoreys - 1);
}

}  // namespace
}  // namespace swiftlet
