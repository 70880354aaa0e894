// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/map_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/backend/store/traversal.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

constexpr double kCellM = 0.2;

/// A beam that looks ahead.
class BeamsAhead {
 public:
  /// Seen from this pose in this traversal. A range of 0: no return.
  void look(std::uint32_t traversal, const Pose2& T_map_body, float range_m, StoreyId storey = {}) {
    FrontendStep step;
    step.keyframe = keyframes_of(make_id<TraversalId>(traversal)).first;
    step.sample.storey = storey;
    step.sample.beam_count = 1;
    step.sample.distance_m[0] = range_m;
    step.sample.status[0] = range_m > 0.0F ? RangeStatus::kHit : RangeStatus::kNoReturn;
    scans_.add(step);
    T_map_body_.push_back(T_map_body);
  }
  [[nodiscard]] double log_evidence() const {
    return log_evidence_in_grid(scans_, T_map_body_, kCellM, Pose2());
  }

 private:
  ScanStore scans_{BeamLayout::multiranger()};
  std::vector<Pose2> T_map_body_;
};

/// From the middle of the cell at the origin; the wall lies in the sixth, which the fifth may belong to.
const Pose2 kHere(0.1, 0.1, 0.0);
constexpr float kRangeM = 1.0F;
constexpr double kCellsMet = 5.0;  // four free ones and the wall

TEST(MapEvidence, HasNothingToSayOfNoBeams) {
  EXPECT_EQ(BeamsAhead().log_evidence(), 0.0);
  BeamsAhead beams;
  beams.look(0, kHere, 0.0F);
  EXPECT_EQ(beams.log_evidence(), 0.0);
}

TEST(MapEvidence, EachCellIsEvenOddsForTheFirstTraversalThatMeetsIt) {
  BeamsAhead beams;
  beams.look(0, kHere, kRangeM);
  EXPECT_NEAR(beams.log_evidence(), kCellsMet * std::log(1.0 / 2.0), 1e-9);
}

TEST(MapEvidence, ATraversalThatAgreesIsLikelierThanOneThatDoesNot) {
  BeamsAhead agree;
  agree.look(0, kHere, kRangeM);
  agree.look(1, kHere, kRangeM);
  EXPECT_NEAR(agree.log_evidence(), kCellsMet * std::log(1.0 / 2.0 * 3.0 / 4.0), 1e-9);
  BeamsAhead contradict;  // the second looks through the wall
  contradict.look(0, kHere, kRangeM);
  contradict.look(1, kHere, 2.0F * kRangeM);
  EXPECT_NEAR(
      contradict.log_evidence(),
      4.0 * std::log(1.0 / 2.0 * 3.0 / 4.0) + std::log(1.0 / 2.0 * 1.0 / 4.0) + 5.0 * std::log(1.0 / 2.0),
      1e-9);
}

TEST(MapEvidence, ATraversalVotesOnceAndForAWallWhereABeamEnds) {
  BeamsAhead once;
  once.look(0, kHere, kRangeM);
  BeamsAhead often;
  for (int i = 0; i < 5; ++i) often.look(0, kHere, kRangeM);
  EXPECT_EQ(often.log_evidence(), once.log_evidence());
  BeamsAhead through;  // and past the wall
  through.look(0, kHere, kRangeM);
  through.look(0, kHere, 2.0F * kRangeM);
  through.look(1, kHere, kRangeM);
  BeamsAhead before;
  before.look(0, kHere, 2.0F * kRangeM);
  before.look(0, kHere, kRangeM);
  before.look(1, kHere, kRangeM);
  EXPECT_NEAR(through.log_evidence(), kCellsMet * std::log(1.0 / 2.0 * 3.0 / 4.0) + 5.0 * std::log(1.0 / 2.0),
              1e-9);
  EXPECT_EQ(before.log_evidence(), through.log_evidence());
}

TEST(MapEvidence, StoreysLieOnNoneOther) {
  BeamsAhead apart;
  apart.look(0, kHere, kRangeM);
  apart.look(1, kHere, kRangeM, make_id<StoreyId>(1));
  EXPECT_NEAR(apart.log_evidence(), 2.0 * kCellsMet * std::log(1.0 / 2.0), 1e-9);
}

TEST(MapEvidence, IsTheSameWhereverTheMapLies) {
  const auto at = [](double x_m, double y_m) {
    BeamsAhead beams;
    beams.look(0, Pose2(0.1 + x_m, 0.1 + y_m, 0.3), 3.0F);
    beams.look(1, Pose2(0.3 + x_m, 0.1 + y_m, 0.3), 3.0F);
    return beams.log_evidence();
  };
  EXPECT_NEAR(at(0.0, 0.0), at(-80.0, 12.8), 1e-9);
}

/// Of one grid it depends on where its lines lie.
TEST(MapEvidence, HardlyDependsOnWhereTheMapLiesInTheGrid) {
  TestVehicle vehicle = vehicle_at_start({}, 75);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  const StoredRun run(vehicle.samples());
  std::vector<double> in_grid;
  std::vector<double> mean;
  for (int i = 0; i < 5; ++i) {
    std::vector<Pose2> path = true_poses(vehicle);
    for (Pose2& T : path) T = Pose2(0.04 * i, 0.03 * i, 0.1 * i) * T;
    in_grid.push_back(log_evidence_in_grid(run.scans(), path, kCellM, Pose2()));
    mean.push_back(map_log_evidence(run.scans(), path, kCellM));
  }
  const auto spread = [](const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return most - least;
  };
  EXPECT_LT(spread(mean), 0.3 * spread(in_grid));
}

/// Twice round the block.
TEST(MapEvidence, OneCorridorIsLikelierThanTwoAndThanWallsThatAreOff) {
  TestVehicle vehicle = vehicle_at_start({}, 75);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  const StoredRun run(vehicle.samples());
  const std::vector<Pose2> truth = true_poses(vehicle);
  const auto second_lap_moved = [&](const Pose2& T_moved) {
    std::vector<Pose2> path = truth;
    for (std::size_t i = path.size() / 2; i < path.size(); ++i) path[i] = T_moved * path[i];
    return map_log_evidence(run.scans(), path, kCellM);
  };
  const double once = map_log_evidence(run.scans(), truth, kCellM);
  EXPECT_GT(once, second_lap_moved(Pose2(30.0, 0.0, 0.0)) + 100.0);
  EXPECT_GT(once, second_lap_moved(Pose2(0.5, 0.5, 0.0)) + 100.0);
  EXPECT_GT(second_lap_moved(Pose2(0.05, 0.0, 0.0)), second_lap_moved(Pose2(0.5, 0.5, 0.0)));
}

}  // namespace
}  // namespace swiftlet
