// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_closer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>

#include "core/backend/store/frontend_estimates.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

using testing::Each;
using testing::Field;
using testing::Not;

constexpr double kEvidence = 9.8;  // of a contradiction, as log odds

/// Two laps of the corridor: a lap brings the vehicle off, and the second meets ground of the first.
TestVehicle two_laps(double drift_rad_per_m) {
  TestVehicleModel model;
  model.drift_rad_per_m = drift_rad_per_m;
  TestVehicle vehicle = vehicle_at_start(model, 3);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  return vehicle;
}

/// A backend without refinement, fed sample by sample.
class FlownLoops {
 public:
  explicit FlownLoops(const TestVehicle& vehicle) : vehicle_(vehicle) {}

  void feed_one() {
    const FrontendStep step = frontend_.process(vehicle_.samples()[scans_.size()]);
    const ScanId scan = scans_.add(step);
    if (!step.has_keyframe) return loops_.search_elsewhere(local(), graph_.graph());
    chain_.add(scan);
    estimates_.take(step.made);
    graph_.add_keyframe(step.made, local());
    loops_.add_keyframe(step.made, local());
    loops_.close_loops(local(), graph_);
    graph_.settle();
  }
  void feed_until_contact() {
    while (loops_.closures().empty() && !is_over()) feed_one();
  }
  void feed_metres(double way_m) {
    for (const double from_m = here_m(); here_m() - from_m < way_m && !is_over();) feed_one();
  }
  /// As a contradiction that began at the newest keyframe.
  void doubt() { loops_.doubt_since(chain_.all().last_id(), kEvidence, graph_); }
  void end_doubt() { loops_.end_doubt(); }
  /// How far the graph has the newest keyframe from where dead reckoning has it.
  [[nodiscard]] double correction_m() const {
    const Pose2& T_map_newest = graph_.T_map_keyframe().values().back();
    return distance_m(T_map_newest.position(), local().values().back().position());
  }
  void optimize() { graph_.optimize(); }
  [[nodiscard]] const LoopCloser& loops() const { return loops_; }

 private:
  [[nodiscard]] bool is_over() const { return scans_.size() == vehicle_.samples().size(); }
  [[nodiscard]] const KeyframePoses& local() const { return estimates_.T_local_keyframe(); }
  [[nodiscard]] double here_m() const {
    return chain_.size() == 0 ? 0.0 : chain_.path_m(chain_.all().last_id());
  }

  const TestVehicle& vehicle_;
  BackendConfig config_;
  DeadReckoningFrontend frontend_;
  ScanStore scans_{BeamLayout::multiranger()};
  KeyframeChain chain_{scans_};
  FrontendEstimates estimates_;
  KeyframeGraph graph_{config_, chain_};
  LoopCloser loops_{config_, scans_, chain_};
};

const auto kIsDropped = Field("dropped", &LoopClosure::dropped, true);

class DriftedLoops : public testing::Test {
 protected:
  TestVehicle vehicle_ = two_laps(0.008);
  FlownLoops flown_{vehicle_};
};

TEST_F(DriftedLoops, AContradictionSoonAfterAContactTakesItsClosuresBack) {
  flown_.feed_until_contact();
  flown_.feed_metres(3.0);
  ASSERT_GT(flown_.correction_m(), 0.5) << "they moved the map";
  const std::size_t closures = flown_.loops().closures().size();
  flown_.doubt();
  EXPECT_THAT(flown_.loops().closures().values(), Each(kIsDropped));
  EXPECT_EQ(flown_.loops().counters().closures_dropped, closures);
  flown_.optimize();
  EXPECT_LT(flown_.correction_m(), 1e-3) << "the graph is free of them";
}

TEST_F(DriftedLoops, TrueOnesAreFoundAgain) {
  flown_.feed_until_contact();
  flown_.feed_metres(3.0);
  flown_.doubt();
  const std::size_t taken_back = flown_.loops().closures().size();
  flown_.feed_metres(6.0);
  const auto found_again = flown_.loops().closures().values().subspan(taken_back);
  ASSERT_FALSE(found_again.empty());
  EXPECT_THAT(found_again, Each(Not(kIsDropped)));
  EXPECT_GT(flown_.correction_m(), 0.5);
}

TEST_F(DriftedLoops, AfterMuchTravelOnKnownGroundTheyStay) {
  flown_.feed_until_contact();
  flown_.feed_metres(16.0);
  flown_.doubt();
  EXPECT_THAT(flown_.loops().closures().values(), Each(Not(kIsDropped)));
}

TEST_F(DriftedLoops, WhatACorrectionOfADoubtfulMotionFoundStays) {
  flown_.feed_metres(38.0);
  ASSERT_TRUE(flown_.loops().closures().empty());
  flown_.doubt();
  flown_.feed_until_contact();
  flown_.end_doubt();
  flown_.feed_metres(3.0);
  flown_.doubt();
  ASSERT_FALSE(flown_.loops().closures().empty());
  EXPECT_THAT(flown_.loops().closures().values(), Each(Not(kIsDropped)))
      << "they are the cure, not the fault";
}

TEST(LoopCloser, ClosuresThatMovedNothingAreNotAtFault) {
  const TestVehicle vehicle = two_laps(0.0);
  FlownLoops flown(vehicle);
  flown.feed_until_contact();
  flown.feed_metres(3.0);
  flown.doubt();
  ASSERT_FALSE(flown.loops().closures().empty());
  EXPECT_THAT(flown.loops().closures().values(), Each(Not(kIsDropped)));
}

}  // namespace
}  // namespace swiftlet
