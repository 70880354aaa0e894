// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Breaks of motion in simulated flights: what was mapped before stays right, and the vehicle finds back.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

TEST(Storeys, AreToldApartAndNotMixed) {
  const CorrectedRun run = corrected_run("sim://storeys?seed=1");
  std::vector<std::size_t> visited;
  for (const RangeSample& sample : run.samples)
    if (visited.empty() || visited.back() != index_of(sample.storey))
      visited.push_back(index_of(sample.storey));
  EXPECT_THAT(visited, testing::ElementsAre(0U, 1U, 0U));
  EXPECT_THAT(run.input.storey_levels_m, testing::ElementsAre(0.0, testing::DoubleNear(3.2, 0.4)));
  EXPECT_LT(error_m(run), 0.2) << "0.29 m where rooms are matched with those below";
  EXPECT_EQ(std::ranges::count(run.tracking, Tracking::kTracking), std::ssize(run.tracking));
}

class MotionBreaksTest : public testing::TestWithParam<const char*> {};

TEST_P(MotionBreaksTest, LeavesTheMapRight) {
  const CorrectedRun run = corrected_run(std::string("sim://maze?seed=2&fault=") + GetParam());
  ASSERT_EQ(run.truth.size(), run.samples.size());
  EXPECT_LT(error_m(run), 0.15);
}

std::size_t samples_in(const CorrectedRun& run, Tracking state) {
  return static_cast<std::size_t>(std::ranges::count(run.tracking, state));
}

TEST(TrackingState, IsGoodAllAlongAHealthyFlight) {
  const CorrectedRun run = corrected_run("sim://maze?seed=2");
  EXPECT_EQ(samples_in(run, Tracking::kTracking), run.samples.size());
}

TEST(TrackingState, IsLostBehindARestartAndGoodAgainOnceThePlaceIsKnown) {
  const CorrectedRun run = corrected_run("sim://maze?seed=1&fault=restart@150:60");
  const auto lost = std::ranges::find(run.tracking, Tracking::kLost);
  ASSERT_NE(lost, run.tracking.end());
  EXPECT_TRUE(run.samples[static_cast<std::size_t>(lost - run.tracking.begin())].starts_segment);
  EXPECT_EQ(std::ranges::count(run.tracking.begin(), lost, Tracking::kTracking), lost - run.tracking.begin());
  EXPECT_EQ(run.tracking.back(), Tracking::kTracking);
}

TEST(TrackingState, IsUncertainBehindATurnThatNobodyTellsWhichIsMended) {
  const CorrectedRun run = corrected_run("sim://maze?seed=2&fault=turn@150:30");
  EXPECT_LT(error_m(run), 0.3);
  EXPECT_EQ(run.tracking.back(), Tracking::kTracking);
  const auto doubted = std::ranges::find(run.tracking, Tracking::kUncertain);
  ASSERT_NE(doubted, run.tracking.end());
  EXPECT_GT(
      run.samples[static_cast<std::size_t>(doubted - run.tracking.begin())].stamp - run.samples[0].stamp,
      std::chrono::seconds(150));
}

TEST(TrackingState, StaysGoodWhereAHeadingLeapsAsNoVehicleTurns) {
  const CorrectedRun run = corrected_run("sim://maze?seed=2&fault=jump@150:30");
  EXPECT_LT(error_m(run), 0.15);
  EXPECT_EQ(samples_in(run, Tracking::kTracking), run.samples.size());
}

TEST(TrackingState, StaysGoodWhereTheEstimateRestartsInFlight) {
  const CorrectedRun run = corrected_run("sim://maze?seed=2&fault=reset@150");
  EXPECT_LT(error_m(run), 0.15);
  EXPECT_EQ(samples_in(run, Tracking::kTracking), run.samples.size());
  EXPECT_THAT(run.input.notes, testing::Contains(testing::HasSubstr("estimate restarted 1 times")));
}

TEST(TrackingState, IsDoubtedOnWhereACorrectionInterruptedTheDoubt) {
  int wrong = 0;
  for (const char* seed : {"1", "5", "6"})
    if (error_m(corrected_run("sim://office?seed=" + std::string(seed) + "&fault=turn@150:20")) > 0.3)
      ++wrong;
  EXPECT_LE(wrong, 1)
      << "two of them, if places that were weighed before the correction do not count behind it";
}

TEST(RestartedVehicle, IsTakenBackFromTheTwinOfTheRoomItStoodIn) {
  int wrong = 0;
  for (const char* seed : {"3", "6", "8"})
    if (error_m(corrected_run("sim://office?seed=" + std::string(seed) + "&fault=restart@80:60")) > 1.0)
      ++wrong;
  EXPECT_LE(wrong, 1) << "all of them, if a place that was accepted is not weighed on";
}

TEST(CarriedVehicle, IsLookedForAnewWhereItsPlaceIsRefuted) {
  int wrong = 0;
  for (const char* seed : {"10", "12", "23"})
    if (error_m(corrected_run("sim://maze?seed=" + std::string(seed) + "&fault=carried@80:60")) > 1.0)
      ++wrong;
  EXPECT_LE(wrong, 1) << "all of them, if a place that was accepted stays until another is";
}

TEST(TurnedVehicle, IsDoubtedThoughASilenceLongBeforeWasNeverPlaced) {
  int wrong = 0;
  for (const char* seed : {"1", "2", "3"}) {
    const std::string flight = "sim://maze?seed=" + std::string(seed);
    if (error_m(corrected_run(flight + "&fault=silence@20:3,turn@150:40")) > 1.0) ++wrong;
  }
  EXPECT_LE(wrong, 1) << "all of them, if a silence explains what contradicts the map later";
}

TEST(SlippedVehicle, IsDrawnWhereItWasUntilTheMapContradictedIt) {
  int wrong = 0;
  for (const char* seed : {"1", "4", "8"})
    if (error_m(corrected_run("sim://office?seed=" + std::string(seed) + "&fault=slip@150:6")) > 0.2) ++wrong;
  EXPECT_LE(wrong, 1) << "all of them, if the doubt stays where the contradiction begins";
}

INSTANTIATE_TEST_SUITE_P(Kinds, MotionBreaksTest,
                         testing::Values("silence@150:60", "reset@150", "restart@150:60", "carried@150:60"));

}  // namespace
}  // namespace swiftlet
