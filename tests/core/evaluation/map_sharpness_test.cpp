// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/map_sharpness.hpp"

#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <vector>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

HostTime at_ms(int ms) { return HostTime(milliseconds(ms)); }

/// Front, left, back, right; all hits.
RangeSample sample(int ms, const std::array<float, 4>& distance_m) {
  RangeSample made;
  made.stamp = at_ms(ms);
  made.beam_count = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    made.distance_m[i] = distance_m[i];
    made.status[i] = RangeStatus::kHit;
  }
  return made;
}

TEST(MapSharpness, CountsCellsOfBothSizesOnce) {
  // First (1.08, 0.03), (0.03, 1.08), (-1.02, 0.03), (0.03, -1.02); from 0.1 m further, turned by a quarter,
  // (0.13, 1.08), (-0.92, 0.03), (0.13, -1.02), (1.18, 0.03): all but the second in a cell of 0.2 m hit
  // before.
  const std::vector<RangeSample> samples{sample(0, {1.05F, 1.05F, 1.05F, 1.05F}),
                                         sample(100, {1.05F, 1.05F, 1.05F, 1.05F})};
  const std::vector<Pose2> poses{Pose2(0.03, 0.03, 0.0), Pose2(0.13, 0.03, kPi / 2.0)};
  const MapSharpness sharpness = map_sharpness(samples, poses, BeamLayout::multiranger());
  EXPECT_EQ(sharpness.returns, 8U);
  EXPECT_EQ(sharpness.cells_10_cm, 8U);
  EXPECT_EQ(sharpness.cells_20_cm, 5U);
}

TEST(MapSharpness, LeavesOutWhatIsNoReturnOrTooCloseOrTooFar) {
  RangeSample one = sample(0, {0.05F, 2.0F, 1.999F, 0.051F});
  RangeSample other = sample(100, {1.0F, 1.0F, 1.0F, 1.0F});
  other.status = {RangeStatus::kNoReturn, RangeStatus::kInvalid, RangeStatus::kHit, RangeStatus::kHit};
  const std::vector<RangeSample> samples{one, other};
  const std::vector<Pose2> poses(2);
  EXPECT_EQ(map_sharpness(samples, poses, BeamLayout::multiranger()).returns, 4U);
}

TEST(FlightSharpness, DrawsEachSampleFromThePathAtItsStamp) {
  // A path of 1 m/s along x: front returns of a wall at x = 2.05.
  const StampedPath path({{at_ms(0), Pose2(0.55, 0.05, 0.0)}, {at_ms(1000), Pose2(1.55, 0.05, 0.0)}});
  const std::vector<RangeSample> samples{sample(0, {1.5F, 0.0F, 0.0F, 0.0F}),
                                         sample(500, {1.0F, 0.0F, 0.0F, 0.0F}),
                                         sample(1000, {0.5F, 0.0F, 0.0F, 0.0F})};
  const FlightSharpness flight = flight_sharpness(samples, path, BeamLayout::multiranger());
  EXPECT_EQ(flight.drawn, 3U);
  EXPECT_EQ(flight.interpolated, 1U);
  EXPECT_EQ(flight.map.returns, 3U);
  EXPECT_EQ(flight.map.cells_10_cm, 1U);
}

TEST(FlightSharpness, NamesTheSamplesThatLieOutsideThePath) {
  const StampedPath path({{at_ms(100), Pose2()}, {at_ms(200), Pose2()}});
  std::vector<RangeSample> samples;
  for (const int ms : {39, 40, 100, 260, 261}) samples.push_back(sample(ms, {1.0F, 1.0F, 1.0F, 1.0F}));
  const FlightSharpness flight = flight_sharpness(samples, path, BeamLayout::multiranger());
  EXPECT_EQ(flight.drawn, 3U);
  EXPECT_EQ(flight.map.returns, 12U);
  EXPECT_THAT(flight.outside, ElementsAre(at_ms(39), at_ms(261)));
  EXPECT_EQ(flight_sharpness(samples, StampedPath({}), BeamLayout::multiranger()).outside.size(), 5U);
}

}  // namespace
}  // namespace swiftlet
