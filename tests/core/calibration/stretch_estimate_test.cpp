// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/stretch_estimate.hpp"

#include <gtest/gtest.h>

#include "tests/core/calibration/room_flight.hpp"

namespace swiftlet {
namespace {

JointEstimate estimate_of(const RoomFlight& flight, const StretchEstimateTuning& tuning = {}) {
  const Result<JointEstimate> estimate = estimate_from_stretches(samples_of(flight), SensorModel::crazyflie(),
                                                                 BeamLayout::multiranger(), tuning);
  EXPECT_TRUE(estimate);
  return *estimate;
}

TEST(StretchEstimate, FindsAgeAndScale) {
  RoomFlight flight;
  flight.age_s = 0.06;
  flight.calibration.forward_scale = 1.06;
  const JointEstimate estimate = estimate_of(flight);
  EXPECT_NEAR(estimate.errors(index_of(SystematicError::kRangeAge)), 0.06, 0.015);
  EXPECT_NEAR(estimate.errors(index_of(SystematicError::kForwardScale)), 0.06, 0.02);
}

TEST(StretchEstimate, FindsTheAgeInShortStretchesOfALongRun) {
  RoomFlight flight;
  flight.age_s = 0.2;
  StretchEstimateTuning tuning;
  tuning.scans = 900;
  tuning.stretch_scans = 300;
  const JointEstimate estimate = estimate_of(flight, tuning);
  EXPECT_NEAR(estimate.errors(index_of(SystematicError::kRangeAge)), 0.2, 0.02);
  EXPECT_LE(estimate.returns_on_them, 4 * tuning.scans);
}

TEST(StretchEstimate, TakesAPartOfTheBeamsOfALaser) {
  StretchEstimateTuning tuning;
  tuning.hits_of_scan = 2;
  EXPECT_LT(estimate_of({}, tuning).returns_on_them, estimate_of({}).returns_on_them * 2 / 3);
}

TEST(StretchEstimate, GivesTheSameTwice) {
  RoomFlight flight;
  flight.scans = 300;
  EXPECT_EQ(estimate_of(flight).errors, estimate_of(flight).errors);
  EXPECT_EQ(estimate_of(flight).sigma, estimate_of(flight).sigma);
}

TEST(StretchEstimate, SaysLittleOfTwoSamples) {
  RoomFlight flight;
  flight.scans = 2;
  EXPECT_GT(estimate_of(flight).sigma(index_of(SystematicError::kRangeAge)), 0.2);
}

}  // namespace
}  // namespace swiftlet
