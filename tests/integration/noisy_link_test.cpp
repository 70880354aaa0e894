// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// Packets that no vehicle sent, among those of one that did.
#include "tests/support/noisy_link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/simulation/link.hpp"
#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

constexpr Duration kLength = std::chrono::seconds(95);
constexpr Duration kNever = std::chrono::hours(1);

CorrectedRun office_run(Duration noise_period) {
  auto simulated = SimulatedLink::open("office", 1).value();
  SimulatedLink& flight = *simulated;
  LinkInput input;
  input.name = "noisy";
  input.starts_logging = true;
  input.truth =
      KnownTruth{[&flight](DeviceTime at) { return flight.T_world_body(at); }, PoseFile::open().value()};
  input.link = std::make_unique<NoisyLink>(std::move(simulated), kLength, noise_period, 1);
  LinkSampleSource source(std::move(input));
  return corrected_run(source);
}

double farthest_m(const CorrectedRun& run) {
  double farthest_m = 0.0;
  for (const Pose2& T_map_body : run.T_map_body)
    farthest_m = std::max(farthest_m, std::hypot(T_map_body.x_m(), T_map_body.y_m()));
  return farthest_m;
}

TEST(NoisyLink, TwoThousandRandomPacketsASecondDoNotHarmTheMap) {
  const CorrectedRun clean = office_run(kNever);
  const CorrectedRun noisy = office_run(std::chrono::microseconds(500));
  EXPECT_EQ(noisy.input.counters.segments, 1U);
  EXPECT_GT(noisy.samples.size(), clean.samples.size() * 99 / 100);
  EXPECT_LT(error_m(noisy), 1.1 * error_m(clean)) << error_m(clean) << " m without noise";
  EXPECT_LT(farthest_m(noisy), farthest_m(clean) + 0.5);
}

}  // namespace
}  // namespace swiftlet
