// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swiftlet {
namespace {

TEST(NoiseSource, RepeatsItselfForTheSameSeedAndName) {
  NoiseSource a(7, "flow");
  NoiseSource b(7, "flow");
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.gaussian(1.0), b.gaussian(1.0));
    EXPECT_EQ(a.uniform(-1.0, 1.0), b.uniform(-1.0, 1.0));
  }
}

TEST(NoiseSource, DiffersBySeedAndByName) {
  const double drawn = NoiseSource(7, "flow").uniform(0.0, 1.0);
  EXPECT_NE(drawn, NoiseSource(8, "flow").uniform(0.0, 1.0));
  EXPECT_NE(drawn, NoiseSource(7, "gyro").uniform(0.0, 1.0));
}

TEST(NoiseSource, IsUncorrelatedBetweenNeighbouringSeeds) {
  double product = 0.0;
  constexpr int kSeeds = 2000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    NoiseSource a(static_cast<std::uint64_t>(seed), "flow");
    NoiseSource b(static_cast<std::uint64_t>(seed) + 1, "flow");
    product += a.gaussian(1.0) * b.gaussian(1.0);
  }
  EXPECT_NEAR(product / kSeeds, 0.0, 4.0 / std::sqrt(kSeeds));
}

TEST(NoiseSource, DrawsWithTheRequestedSigma) {
  NoiseSource noise(1, "any");
  constexpr int kDraws = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = noise.gaussian(0.5);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * 0.5 / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(squares / kDraws), 0.5, 0.01);
}

TEST(NoiseSource, MeetsTheProbabilityOfAChance) {
  NoiseSource noise(1, "any");
  int taken = 0;
  for (int i = 0; i < 20000; ++i) taken += noise.chance(0.1) ? 1 : 0;
  EXPECT_NEAR(taken / 20000.0, 0.1, 0.01);
  EXPECT_FALSE(noise.chance(0.0));
  EXPECT_TRUE(noise.chance(1.0));
}

}  // namespace
}  // namespace swiftlet
