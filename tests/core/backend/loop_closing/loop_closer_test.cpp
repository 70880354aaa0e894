// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_closer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "core/backend/loop_closing/return_evidence.hpp"
#include "core/backend/store/frontend_estimates.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/loop_corridor.hpp"

namespace swiftlet {
namespace {

using testing::Each;
using testing::Field;
using testing::Not;

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
  explicit FlownLoops(const TestVehicle& vehicle, const BackendConfig& config = {})
      : vehicle_(vehicle), config_(config) {}

  void feed_one() { feed(vehicle_.samples()[scans_.size()]); }
  /// Nothing was received for a while, but the estimate ran on.
  void feed_one_after_silence() { feed_one_after_break(true); }
  /// The estimate began anew.
  void feed_one_after_reset() { feed_one_after_break(false); }
  void feed_until_unplaced() {
    while (!loops_.unplaced_since() && !is_over()) feed_one();
  }
  void feed_until_placed() {
    while (loops_.unplaced_since() && !is_over()) feed_one();
  }
  void feed_until_beyond_doubt() {
    while (loops_.provisional_since() && !is_over()) feed_one();
  }
  void feed_until_contact() {
    while (loops_.closures().empty() && !is_over()) feed_one();
  }
  void feed_metres(double way_m) {
    for (const double from_m = here_m(); here_m() - from_m < way_m && !is_over();) feed_one();
  }
  void doubt_newest_motion() { loops_.doubt_since(chain_.all().last_id(), 9.8); }
  void end_doubt() { loops_.end_doubt(); }
  void prune_nothing() { loops_.erase({}); }
  void drop_contact() { loops_.drop_contact(graph_); }
  /// In a map that has what was flown from the middle on so much farther along x.
  void drop_those_off(double moved_m) {
    KeyframePoses T_map_keyframe = graph_.T_map_keyframe();
    for (Pose2& T : T_map_keyframe.values().subspan(T_map_keyframe.size() / 2))
      T = Pose2(moved_m, 0.0, 0.0) * T;
    loops_.drop_those_off(T_map_keyframe, graph_);
  }
  [[nodiscard]] std::optional<LoopCloser::Contact> contact_that_moved() const {
    return loops_.contact_that_moved(graph_.graph());
  }
  /// Of what was seen since a contact against what was mapped long before, from where the graph has it and
  /// from where dead reckoning has it.
  struct Evidence {
    double by_graph;
    double by_dead_reckoning;
  };
  [[nodiscard]] Evidence evidence_since(const LoopCloser::Contact& contact) const {
    const ReturnEvidence returns(config_.tuning.confidence, scans_);
    const ScanRange since{chain_.scan_of(contact.since), scans_.all().end_id()};
    const auto against = [&](const KeyframePoses& T_map_seen_from) {
      return returns.against(since, chain_.T_w_bodies(since, T_map_seen_from),
                             config_.tuning.confidence.old_after_m, loops_.submaps(),
                             graph_.T_map_keyframe());
    };
    return {against(graph_.T_map_keyframe()), against(local())};
  }
  /// How far the graph has the newest keyframe from where dead reckoning has it.
  [[nodiscard]] double correction_m() const {
    const Pose2& T_map_newest = graph_.T_map_keyframe().values().back();
    return distance_m(T_map_newest.position(), local().values().back().position());
  }
  void optimize() { graph_.optimize(); }
  [[nodiscard]] ScanId newest_scan() const { return scans_.all().last_id(); }
  [[nodiscard]] const LoopCloser& loops() const { return loops_; }
  [[nodiscard]] bool is_over() const { return scans_.size() == vehicle_.samples().size(); }

 private:
  void feed_one_after_break(bool estimate_ran_on) {
    RangeSample sample = vehicle_.samples()[scans_.size()];
    sample.starts_segment = true;
    sample.odometry_ran_on = estimate_ran_on;
    feed(sample);
  }
  void feed(const RangeSample& sample) {
    const FrontendStep step = frontend_.process(sample);
    const ScanId scan = scans_.add(step);
    if (!step.has_keyframe) return loops_.search_elsewhere(local(), graph_.graph());
    chain_.add(scan);
    estimates_.take(step.made);
    graph_.add_keyframe(step.made, local());
    loops_.add_keyframe(step.made, local());
    loops_.close_loops(local(), graph_);
    graph_.settle();
  }
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

TEST_F(DriftedLoops, WithoutTheClosuresOfAContactTheGraphIsAsBefore) {
  flown_.feed_until_contact();
  flown_.feed_metres(3.0);
  ASSERT_GT(flown_.correction_m(), 0.5) << "they moved the map";
  ASSERT_TRUE(flown_.contact_that_moved());
  const std::size_t closures = flown_.loops().closures().size();
  flown_.drop_contact();
  EXPECT_THAT(flown_.loops().closures().values(), Each(kIsDropped));
  EXPECT_EQ(flown_.loops().counters().closures_dropped, closures);
  EXPECT_FALSE(flown_.contact_that_moved());
  flown_.optimize();
  EXPECT_LT(flown_.correction_m(), 1e-3);
}

TEST_F(DriftedLoops, ThoseThatTheFinalMapDoesNotHoldAreDropped) {
  while (!flown_.is_over()) flown_.feed_one();
  const std::size_t closures = flown_.loops().closures().size();
  flown_.drop_those_off(0.0);
  EXPECT_EQ(flown_.loops().counters().closures_dropped, 0);
  EXPECT_THAT(flown_.loops().closures().values(), Each(Not(kIsDropped)));
  flown_.drop_those_off(5.0);
  const std::uint64_t dropped = flown_.loops().counters().closures_dropped;
  EXPECT_GT(dropped, closures / 2);
  flown_.drop_those_off(5.0);
  EXPECT_EQ(flown_.loops().counters().closures_dropped, dropped) << "each once";
}

TEST_F(DriftedLoops, TrueOnesAreFoundAgain) {
  flown_.feed_until_contact();
  flown_.feed_metres(3.0);
  flown_.drop_contact();
  const std::size_t dropped = flown_.loops().closures().size();
  flown_.feed_metres(6.0);
  const auto found_again = flown_.loops().closures().values().subspan(dropped);
  ASSERT_FALSE(found_again.empty());
  EXPECT_THAT(found_again, Each(Not(kIsDropped)));
  EXPECT_GT(flown_.correction_m(), 0.5);
}

TEST_F(DriftedLoops, AfterMuchTravelOnKnownGroundAContactIsOld) {
  flown_.feed_until_contact();
  flown_.feed_metres(16.0);
  EXPECT_FALSE(flown_.contact_that_moved());
}

TEST_F(DriftedLoops, TheTravelSinceATrueContactContradictsTheMapWithoutIt) {
  flown_.feed_until_contact();
  flown_.feed_metres(10.0);
  const std::optional<LoopCloser::Contact> contact = flown_.contact_that_moved();
  ASSERT_TRUE(contact);
  const auto [by_graph, by_dead_reckoning] = flown_.evidence_since(*contact);
  EXPECT_LT(by_graph, 0.0);
  EXPECT_GT(by_dead_reckoning, by_graph + 9.8) << "the evidence that an alarm takes";
}

TEST(LoopCloser, APlaceBehindABreakIsAContactThatMovedTheMap) {
  TestVehicle vehicle = vehicle_at_start({}, 3);
  fly_along(vehicle, loop_corridor(), "bcda");
  const Point2 start = loop_corridor().place('a');
  vehicle.carry_to(loop_corridor(), Pose2(start.x_m + 0.7, start.y_m + 0.5, 0.2));
  fly_along(vehicle, loop_corridor(), "bcda");
  FlownLoops flown(vehicle);
  while (!flown.loops().unplaced_since()) flown.feed_one();
  for (int metre = 0; flown.loops().unplaced_since() && metre < 30; ++metre) flown.feed_metres(1.0);
  ASSERT_FALSE(flown.loops().unplaced_since());
  EXPECT_TRUE(flown.contact_that_moved());
}

/// Two laps of the corridor, carried off at the end of the second and restarted there.
TestVehicle carried_behind_two_laps() {
  TestVehicle vehicle = two_laps(0.0);
  const Point2 start = loop_corridor().place('a');
  vehicle.carry_to(loop_corridor(), Pose2(start.x_m + 0.7, start.y_m + 0.5, 0.2));
  fly_along(vehicle, loop_corridor(), "bcdabc");
  return vehicle;
}

TEST(LoopCloser, APlaceBehindABreakIsAContactOfItsOwn) {
  const TestVehicle vehicle = carried_behind_two_laps();
  FlownLoops flown(vehicle);
  flown.feed_until_unplaced();
  ASSERT_FALSE(flown.loops().closures().empty()) << "it was on known ground";
  const KeyframeId restarted = flown.loops().unplaced_since().value();
  flown.feed_until_placed();
  ASSERT_FALSE(flown.loops().unplaced_since());
  ASSERT_TRUE(flown.contact_that_moved());
  EXPECT_GE(flown.contact_that_moved()->since, restarted);
}

TEST(LoopCloser, APlaceBehindARestartIsProvisionalUntilItIsBeyondDoubt) {
  const TestVehicle vehicle = carried_behind_two_laps();
  FlownLoops flown(vehicle);
  flown.feed_until_unplaced();
  const std::optional<KeyframeId> restarted = flown.loops().unplaced_since();
  EXPECT_FALSE(flown.loops().provisional_since());
  flown.feed_until_placed();
  EXPECT_EQ(flown.loops().provisional_since(), restarted);
  EXPECT_GT(flown.loops().places_weighed(), 1U);
  flown.feed_metres(10.0);
  EXPECT_FALSE(flown.loops().weighs_places());
}

/// A vehicle that was carried has a place, which is not beyond doubt.
class ProvisionalPlace : public testing::Test {
 protected:
  void SetUp() override {
    flown_.feed_until_unplaced();
    restarted_ = flown_.loops().unplaced_since();
    flown_.feed_until_placed();
    ASSERT_TRUE(restarted_);
    ASSERT_EQ(flown_.loops().provisional_since(), restarted_);
  }
  void expect_unplaced_since_the_restart() const {
    EXPECT_EQ(flown_.loops().unplaced_since(), restarted_);
    EXPECT_EQ(flown_.loops().unplaced_by(), UnplacedBy::kRestart);
  }

  TestVehicle vehicle_ = carried_behind_two_laps();
  FlownLoops flown_{vehicle_};
  std::optional<KeyframeId> restarted_;
};

TEST_F(ProvisionalPlace, IsWeighedOnAcrossASilenceThatIsPlacedThen) {
  flown_.feed_one_after_silence();
  EXPECT_EQ(flown_.loops().provisional_since(), restarted_);
  flown_.feed_until_beyond_doubt();
  EXPECT_EQ(flown_.loops().unplaced_by(), UnplacedBy::kSilence);
  EXPECT_GT(flown_.loops().unplaced_since(), restarted_);
  flown_.feed_until_placed();
  EXPECT_FALSE(flown_.loops().unplaced_since());
}

TEST_F(ProvisionalPlace, IsLookedForAnewWhereSomethingIsPruned) {
  flown_.prune_nothing();
  expect_unplaced_since_the_restart();
}

TEST_F(ProvisionalPlace, IsLookedForAnewBehindASecondRestart) {
  flown_.feed_one_after_reset();
  expect_unplaced_since_the_restart();
}

TEST(LoopCloser, TheGroundBeforeABreakIsKnownUpToThere) {
  const TestVehicle vehicle = carried_behind_two_laps();
  FlownLoops flown(vehicle);
  flown.feed_until_unplaced();
  EXPECT_EQ(flown.loops().submaps().back()->scans.end, flown.newest_scan());
}

TEST(LoopCloser, ASilenceDoesNotPlaceWhoWasCarriedBefore) {
  const TestVehicle vehicle = carried_behind_two_laps();
  FlownLoops flown(vehicle);
  flown.feed_until_unplaced();
  const std::optional<KeyframeId> restarted = flown.loops().unplaced_since();
  flown.feed_metres(1.0);
  flown.feed_one_after_silence();
  flown.feed_metres(1.0);
  EXPECT_EQ(flown.loops().unplaced_since(), restarted);
  EXPECT_EQ(flown.loops().unplaced_by(), UnplacedBy::kRestart);
  flown.feed_until_placed();
  EXPECT_FALSE(flown.loops().unplaced_since());
}

TEST(LoopCloser, WhatWasFlownBetweenTwoRestartsIsNoOlderMap) {
  const TestVehicle vehicle = carried_behind_two_laps();
  FlownLoops flown(vehicle);
  flown.feed_until_unplaced();
  const KeyframeId restarted = flown.loops().unplaced_since().value();
  flown.feed_metres(1.0);
  const std::size_t closures = flown.loops().closures().size();
  flown.feed_one_after_reset();
  flown.feed_metres(3.0);
  EXPECT_EQ(flown.loops().unplaced_since(), restarted);
  flown.feed_until_placed();
  ASSERT_FALSE(flown.loops().unplaced_since());
  for (const LoopClosure& closure : flown.loops().closures().values().subspan(closures))
    EXPECT_LT(closure.from, restarted);
}

TEST(LoopCloser, BehindASilenceOldGroundIsFoundAsFarOffAsItsEstimateDrifts) {
  const TestVehicle vehicle = two_laps(0.008);
  BackendConfig config;
  config.tuning.places.unmoved_reach_m = 0.1;
  FlownLoops flown(vehicle, config);
  flown.feed_metres(10.0);
  flown.feed_one_after_silence();
  ASSERT_EQ(flown.loops().unplaced_by(), UnplacedBy::kSilence);
  flown.feed_until_placed();
  EXPECT_FALSE(flown.loops().unplaced_since());
  EXPECT_GT(flown.correction_m(), 0.5) << "much farther than it moves unseen";
}

TEST(LoopCloser, NoMatchAcrossASilenceIsSureAloneInDoubt) {
  const TestVehicle vehicle = two_laps(0.008);
  FlownLoops flown(vehicle);
  flown.feed_until_contact();
  flown.doubt_newest_motion();
  flown.feed_one_after_silence();
  const std::size_t closures = flown.loops().closures().size();
  flown.feed_metres(2.0);
  EXPECT_EQ(flown.loops().closures().size(), closures);
}

TEST(LoopCloser, WhatADoubtLeavesOfASilenceIsLookedForOnceItHasEnded) {
  const TestVehicle vehicle = two_laps(0.008);
  FlownLoops flown(vehicle);
  flown.feed_until_contact();
  flown.feed_one_after_silence();
  const std::optional<KeyframeId> silence = flown.loops().unplaced_since();
  ASSERT_TRUE(silence);
  flown.feed_metres(0.5);
  flown.doubt_newest_motion();
  ASSERT_EQ(flown.loops().unplaced_by(), UnplacedBy::kContradiction);
  flown.end_doubt();
  EXPECT_EQ(flown.loops().unplaced_by(), UnplacedBy::kSilence);
  EXPECT_EQ(flown.loops().unplaced_since(), silence);
}

TEST(LoopCloser, ABreakBeforeAnythingIsMappedLeavesNoPlaceToBeFound) {
  const TextRoom room = loop_corridor();
  const Point2 start = room.place('a');
  TestVehicle vehicle = vehicle_at_start({}, 3);
  vehicle.fly_to(room, {start.x_m + 2.0, start.y_m});
  vehicle.carry_to(room, Pose2(start.x_m, start.y_m, 0.0));
  fly_along(vehicle, room, "bcd");
  FlownLoops flown(vehicle);
  flown.feed_metres(20.0);
  EXPECT_FALSE(flown.loops().unplaced_since());
  EXPECT_FALSE(flown.loops().submaps().empty());
}

TEST(LoopCloser, APlaceThatTrackingHadAllTheTimeAddsNoClosureTwice) {
  const TestVehicle vehicle = two_laps(0.0);
  FlownLoops flown(vehicle);
  flown.feed_until_contact();
  flown.doubt_newest_motion();
  for (int metre = 0; flown.loops().unplaced_since() && metre < 30; ++metre) flown.feed_metres(1.0);
  ASSERT_FALSE(flown.loops().unplaced_since());
  std::set<std::pair<KeyframeId, KeyframeId>> joined;
  for (const LoopClosure& closure : flown.loops().closures().values())
    EXPECT_TRUE(joined.insert({closure.from, closure.to}).second);
}

TEST(LoopCloser, APlaceThatEndsADoubtIsTakenBackAsAWhole) {
  const TestVehicle vehicle = two_laps(0.0);
  FlownLoops flown(vehicle);
  flown.feed_metres(30.0);
  ASSERT_TRUE(flown.loops().closures().empty());
  flown.doubt_newest_motion();
  flown.feed_until_placed();
  ASSERT_FALSE(flown.loops().closures().empty());
  flown.drop_contact();
  EXPECT_THAT(flown.loops().closures().values(), Each(kIsDropped));
}

TEST(LoopCloser, AContactThatMovedNothingIsNotAtFault) {
  const TestVehicle vehicle = two_laps(0.0);
  FlownLoops flown(vehicle);
  flown.feed_until_contact();
  flown.feed_metres(3.0);
  ASSERT_FALSE(flown.loops().closures().empty());
  EXPECT_FALSE(flown.contact_that_moved());
}

}  // namespace
}  // namespace swiftlet
