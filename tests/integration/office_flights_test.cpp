// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// What the demo promises: the simulated office comes out right whatever the seed.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

class OfficeFlights : public testing::TestWithParam<int> {};

TEST_P(OfficeFlights, AreCorrectedToAFifthOfTheOdometrysError) {
  const CorrectedRun run = corrected_run("sim://office?seed=" + std::to_string(GetParam()));
  ASSERT_GT(run.samples.size(), 4000U);
  ASSERT_EQ(run.truth.size(), run.samples.size());
  const double before_m = error_m(run, dead_reckoned(run));
  const double after_m = error_m(run);
  EXPECT_LE(after_m, 0.2 * before_m) << before_m << " m before, " << after_m << " m after";
}

INSTANTIATE_TEST_SUITE_P(Seeds, OfficeFlights, testing::Range(1, 6));

}  // namespace
}  // namespace swiftlet
