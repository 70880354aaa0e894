// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/systematic_prior.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

constexpr auto kForward = index_of(SystematicError::kForwardScale);
constexpr auto kSideways = index_of(SystematicError::kSidewaysScale);

TEST(SystematicPrior, TheScalesOfAFlowSensorErrTogether) {
  const SystematicCovariance flow = covariance_of({.scale = 0.03, .scales_apart = 0.01}, false);
  EXPECT_NEAR(flow(kForward, kForward), 0.03 * 0.03 + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(flow(kForward, kForward) + flow(kSideways, kSideways) - 2.0 * flow(kForward, kSideways),
              2.0 * 0.01 * 0.01, 1e-12);
}

TEST(SystematicPrior, WheelsDoNotMoveSideways) {
  const SystematicCovariance wheels = covariance_of({}, true);
  EXPECT_EQ(wheels.col(kSideways).norm(), 0.0);
  EXPECT_GT(wheels(kForward, kForward), 0.0);
}

TEST(SystematicPrior, AnErrorThatIsNoneIsHeld) {
  const SystematicCovariance prior = covariance_of({}, true);
  const SystematicCovariance information = information_of(prior);
  EXPECT_NEAR(information(kForward, kForward) * prior(kForward, kForward), 1.0, 1e-9);
  EXPECT_GT(information(kSideways, kSideways), 1e15);
}

}  // namespace
}  // namespace swiftlet
