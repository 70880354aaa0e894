// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/place_hypotheses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/other_storey.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::Ge;
using testing::Gt;
using testing::IsEmpty;
using testing::SizeIs;
using testing::Truly;

const Pose2 kNowhere(500.0, 0.0, 0.0);  // ground that no submap shows
constexpr Duration kLong = std::chrono::hours(1);
constexpr double kAny = 1e9;

/// A flight that is mapped, a break, and the travel since: known walls, whose place has to be found.
struct BrokenFlight {
  std::size_t break_at = 0;  // the first sample of the travel
  TestVehicle vehicle;

  /// `mapped`, `travelled`: places along which it flies before and since. The break leads to the first of
  /// `travelled`.
  static BrokenFlight along(const TextRoom& room, const std::string& mapped, const std::string& travelled) {
    const Point2 start = room.place(mapped[0]);
    TestVehicle vehicle(room, Pose2(start.x_m, start.y_m, 0.0), {}, 7);
    for (const char place : mapped.substr(1)) vehicle.fly_to(room, room.place(place));
    const std::size_t break_at = vehicle.samples().size();
    const Point2 again = room.place(travelled[0]);
    vehicle.carry_to(room, Pose2(again.x_m, again.y_m, 0.0));
    for (const char place : travelled.substr(1)) vehicle.fly_to(room, room.place(place));
    return {break_at, vehicle};
  }
  /// Dead reckoning: the truth, and since the break another place and heading and a metre of `scale`.
  [[nodiscard]] std::vector<Pose2> T_local_body(double scale) const {
    const std::vector<Pose2>& truth = vehicle.T_world_body();
    std::vector<Pose2> T_local(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(break_at));
    T_local.emplace_back(31.0, -17.0, radians(140.0));
    for (std::size_t i = break_at + 1; i < truth.size(); ++i) {
      const Pose2 moved = between(truth[i - 1], truth[i]);
      T_local.push_back(T_local.back() * Pose2(scale * moved.x_m(), scale * moved.y_m(), moved.yaw_rad()));
    }
    return T_local;
  }
};

class PlaceHypothesesTest : public testing::Test {
 protected:
  static MotionBreak carried_for(Duration unwatched, double log_odds_moved = 0.0) {
    return {unwatched, std::nullopt, log_odds_moved, false};
  }
  /// While its estimate ran on.
  [[nodiscard]] MotionBreak moved_unwatched(Duration unwatched, double log_odds_moved = 0.0) const {
    return {unwatched, since_ - 1, log_odds_moved, false};
  }
  explicit PlaceHypothesesTest(const BrokenFlight& flight = round_the_corridor(), double scale = 1.0)
      : flight_(flight), run_(flight.vehicle.samples(), flight.T_local_body(scale)) {
    while (run_.chain().scan_of(since_) < make_id<ScanId>(flight_.break_at)) ++since_;
    newest_ = since_;
    graph_.T_map_keyframe = run_.T_local_keyframe();
    put_travel(Pose2());
    map(KeyframeId{}, since_);
  }

  static BrokenFlight round_the_corridor() { return BrokenFlight::along(loop_corridor(), "abcda", "abcd"); }
  [[nodiscard]] Pose2 T_world(KeyframeId keyframe) const {
    return flight_.vehicle.T_world_body()[index_of(run_.chain().scan_of(keyframe))];
  }
  /// Where the graph has the travel, so far from the truth.
  void put_travel(const Pose2& T_map_world) {
    for (KeyframeId k = since_; k <= run_.newest(); ++k) graph_.T_map_keyframe[k] = T_map_world * T_world(k);
  }
  /// As if the vehicle had turned by so much in place at the break.
  void turn_travel(double yaw_rad) {
    const Pose2& T_map_before = graph_.T_map_keyframe[since_ - 1];
    put_travel(T_map_before * Pose2(0.0, 0.0, yaw_rad) * T_map_before.inverse());
  }
  /// Submaps of 6 m that overlap by half, of the keyframes from `first` up to `end`.
  void map(KeyframeId first, KeyframeId end) {
    submaps_.clear();
    const auto behind = [&](KeyframeId from, double way_m) {
      KeyframeId k = from;
      while (k < end && run_.chain().path_m(k) < run_.chain().path_m(from) + way_m) ++k;
      return k;
    };
    for (KeyframeId from = first; behind(from, 6.0) < end; from = behind(from, 3.0))
      submaps_.push_back(std::make_shared<const Submap>(build_submap(
          from, behind(from, 6.0), run_.scans(), run_.chain(), run_.T_local_keyframe(), config_)));
  }
  /// `changed`: what becomes of 255 * p(occupied).
  void change_cells(std::uint8_t (*changed)(std::uint8_t occupied)) {
    for (auto& submap : submaps_) {
      Submap other = *submap;
      std::ranges::transform(other.cells, other.cells.begin(), changed);
      submap = std::make_shared<const Submap>(std::move(other));
    }
  }
  /// The scans of the last 6 m since the break.
  [[nodiscard]] ScanRange recent(KeyframeId query) const {
    ScanId first = run_.chain().scan_of(since_);
    const double from_m = run_.chain().path_m(query) - config_.multiscan_length_m;
    while (run_.scans()[first].path_m < from_m) ++first;
    return {first, run_.chain().scan_of(query) + 1};
  }
  /// The likeliest place is accepted, and the graph has the travel there: so far from the truth.
  void accept(const Pose2& T_map_world) {
    places_.accept_likeliest();
    path_ = graph_.T_map_keyframe;
    put_travel(T_map_world);
  }
  [[nodiscard]] const KeyframePoses& path() const { return path_ ? *path_ : graph_.T_map_keyframe; }
  bool add(KeyframeId query) {
    return places_.add_query(query, recent(query), submaps_, graph_, run_.T_local_keyframe(), path());
  }
  /// Goes on along the travel until one more query is taken. Returns its keyframe.
  KeyframeId take_query() {
    while (newest_ < run_.newest())
      if (add(++newest_)) return newest_;
    ADD_FAILURE() << "the travel is over";
    return newest_;
  }
  void take_queries(int count) {
    for (int i = 0; i < count; ++i) take_query();
  }
  /// How many queries it takes until a place is accepted; 0: the travel is over before.
  int queries_until_decided() {
    int count = 0;
    while (newest_ < run_.newest() && places_.decided().empty()) count += add(++newest_) ? 1 : 0;
    return places_.decided().empty() ? 0 : count;
  }
  /// A match says that the newest query lies so far from where it truly is.
  void propose(const Pose2& T_map_world) {
    const KeyframeId from = submaps_.front()->reference;
    LoopClosure match;
    match.from = from;
    match.to = newest_;
    match.T_from_to = between(graph_.T_map_keyframe[from], T_map_world * T_world(newest_));
    places_.propose(match, submaps_, graph_, path());
  }
  /// Begins with the travel where no submap shows anything, and a match at the true place.
  void begin_nowhere(double log_odds_moved) {
    put_travel(kNowhere);
    newest_ = since_;
    places_.begin(carried_for(kLong, log_odds_moved));
    take_query();
    propose(Pose2());
  }
  /// Begins with the travel behind the walls, where what beams meet is unknown, and a match at the true
  /// place.
  int queries_until_true_place(const MotionBreak& motion_break) {
    put_travel(Pose2(1.2, 1.2, 0.0));
    newest_ = since_;
    places_.begin(motion_break);
    take_query();
    propose(Pose2());
    return queries_until_decided();
  }
  void make_returns_say_nothing() {
    config_.tuning.confidence.share_if_off = config_.tuning.confidence.share_if_right;
  }
  void expect_true(const std::vector<LoopClosure>& matches) const {
    for (const LoopClosure& match : matches)
      EXPECT_TRUE(poses_near(graph_.T_map_keyframe[match.from] * match.T_from_to, T_world(match.to), 0.3,
                             radians(2.0)));
  }

  BackendConfig config_;
  BrokenFlight flight_;
  StoredRun run_;
  KeyframeId since_{};  // the first keyframe since the break
  PoseGraph graph_;
  std::optional<KeyframePoses> path_;  // as it was before a place was accepted
  std::vector<std::shared_ptr<const Submap>> submaps_;
  PlaceHypotheses places_{config_, run_.scans(), run_.chain()};
  KeyframeId newest_{};  // of the travel that was offered
};

TEST_F(PlaceHypothesesTest, NotHavingMovedWinsWhereTheGroundAgrees) {
  config_.tuning.places.max_sigma_m = kAny;
  places_.begin(carried_for(seconds(10)));
  take_queries(2);
  EXPECT_THAT(places_.decided(), IsEmpty()) << "two matches, however likely, are too few";
  take_query();
  EXPECT_THAT(places_.decided(), SizeIs(3));
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesTest, MatchesThatLeaveThePositionOpenDecideNothing) {
  places_.begin(carried_for(seconds(10)));
  take_queries(3);  // along one side
  EXPECT_THAT(places_.decided(), IsEmpty());
  config_.tuning.places.max_sigma_m = kAny;
  EXPECT_THAT(places_.decided(), SizeIs(3)) << "but for the position they would";
  config_.tuning.places.max_sigma_m = PlaceHypothesesTuning().max_sigma_m;
  take_query();  // nearer to the corner
  EXPECT_THAT(places_.decided(), SizeIs(4));
}

TEST_F(PlaceHypothesesTest, KnownGroundRefutesNotHavingMoved) {
  put_travel(Pose2(2.5, 1.5, 0.0));
  places_.begin(carried_for(seconds(10)));
  EXPECT_EQ(queries_until_decided(), 0);
}

TEST_F(PlaceHypothesesTest, APlaceFoundElsewhereIsAcceptedAfterThreeMatches) {
  put_travel(Pose2(2.5, 1.5, 0.0));
  places_.begin(carried_for(seconds(10)));
  take_query();
  propose(Pose2());
  ASSERT_EQ(places_.size(), 2U);
  const int more = queries_until_decided();
  ASSERT_GT(more, 1) << "two matches are too few";
  EXPECT_THAT(places_.decided(), SizeIs(more + 1)) << "one for each query, from the first on";
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesTest, BeamsThroughWallsSpeakAgainstAPlace) {
  const int heeded = queries_until_true_place(carried_for(seconds(10)));
  make_returns_say_nothing();
  const int unheeded = queries_until_true_place(carried_for(seconds(10)));
  ASSERT_GT(heeded, 0);
  EXPECT_TRUE(unheeded == 0 || unheeded > heeded) << unheeded << " in place of " << heeded;
}

TEST_F(PlaceHypothesesTest, WhereTheEstimateRanOnBeamsThroughWallsSayNothing) {
  config_.tuning.places.not_moved_odds = 1e12;
  const int usually = queries_until_true_place(moved_unwatched(seconds(0)));
  ASSERT_GT(usually, 0);
  make_returns_say_nothing();
  EXPECT_EQ(queries_until_true_place(moved_unwatched(seconds(0))), usually);
}

TEST_F(PlaceHypothesesTest, AnotherStoreyIsNoEvidence) {
  submaps_ = one_storey_up(submaps_);
  places_.begin(carried_for(seconds(10)));
  EXPECT_EQ(queries_until_decided(), 0);
}

TEST_F(PlaceHypothesesTest, WhereNothingIsKnownNothingIsDecided) {
  put_travel(kNowhere);
  places_.begin(carried_for(seconds(10)));
  EXPECT_EQ(queries_until_decided(), 0);
  EXPECT_EQ(places_.size(), 1U);
}

TEST_F(PlaceHypothesesTest, UnknownGroundIsNoEvidence) {
  places_.begin(carried_for(seconds(10)));
  ASSERT_GT(queries_until_decided(), 0);
  const std::size_t known = places_.decided().size();
  change_cells([](std::uint8_t) { return std::uint8_t{0}; });
  take_queries(6);
  EXPECT_THAT(places_.decided(), SizeIs(known)) << "neither for nor against";
}

TEST_F(PlaceHypothesesTest, AMatchOfWhatIsLikelierFreeIsNoneOfItsMatches) {
  change_cells([](std::uint8_t occupied) { return static_cast<std::uint8_t>((occupied + 1) / 2); });
  config_.min_score = 0.05;
  config_.tuning.places.max_sigma_m = kAny;
  config_.tuning.places.not_moved_odds = 1e300;
  places_.begin(carried_for(seconds(10)));
  take_queries(4);
  EXPECT_THAT(places_.decided(), IsEmpty());
}

TEST_F(PlaceHypothesesTest, APlaceThatIsFoundHasToOutdoNotHavingMoved) {
  begin_nowhere(0.0);
  const int usually = queries_until_decided();
  ASSERT_GT(usually, 0);
  begin_nowhere(std::log(config_.tuning.places.not_moved_odds));
  const int with_evidence_of_a_move = queries_until_decided();
  EXPECT_LT(with_evidence_of_a_move, usually);
  EXPECT_GT(with_evidence_of_a_move, 0);
  config_.tuning.places.not_moved_odds = 1e12;
  begin_nowhere(0.0);
  EXPECT_GT(queries_until_decided(), usually);
}

TEST_F(PlaceHypothesesTest, APlaceThatIsFoundIsOneOfManyThatWereSearched) {
  const double certainly_moved = 100.0;
  begin_nowhere(certainly_moved);
  const int usually = queries_until_decided();
  ASSERT_GT(usually, 0);
  config_.tuning.places.places_per_submap = 1e12;
  begin_nowhere(certainly_moved);
  EXPECT_GT(queries_until_decided(), usually);
}

TEST_F(PlaceHypothesesTest, IsAThousandTimesLikelierThanGroundThatTheMapDoesNotShow) {
  const double certainly_moved = 100.0;
  begin_nowhere(certainly_moved);
  ASSERT_GT(queries_until_decided(), 0);
  config_.tuning.places.sure_log_odds = 1e3;
  EXPECT_THAT(places_.decided(), IsEmpty());
}

TEST_F(PlaceHypothesesTest, NothingIsFartherOffThanItCanHaveBeenCarried) {
  put_travel(Pose2(10.0, 0.0, 0.0));
  for (const auto& [unwatched, count] : {std::pair(milliseconds(3900), 1U), {milliseconds(4100), 2U}}) {
    newest_ = since_;
    places_.begin(carried_for(unwatched));
    take_query();
    propose(Pose2());
    EXPECT_EQ(places_.size(), count) << "2 m, and 2 m/s";
  }
}

TEST_F(PlaceHypothesesTest, ATurnLeadsAsFarAsTheTravelSince) {
  turn_travel(radians(85.0));
  places_.begin(moved_unwatched(seconds(0)));
  take_queries(6);
  ASSERT_GT(distance_m(graph_.T_map_keyframe[newest_].position(), T_world(newest_).position()), 10.0);
  const std::size_t before = places_.size();
  propose(Pose2());
  EXPECT_EQ(places_.size(), before + 1) << "it did not move by more than 2 m where it turned";
}

TEST_F(PlaceHypothesesTest, UnwatchedItMovesNoFartherThanItCanHaveBeenCarried) {
  put_travel(kNowhere);
  places_.begin(moved_unwatched(seconds(0)));
  take_query();
  propose(Pose2());
  EXPECT_EQ(places_.size(), 1U);
}

TEST_F(PlaceHypothesesTest, AVehicleThatTurnedUnwatchedIsFoundAmongItsTurns) {
  turn_travel(radians(50.0));
  places_.begin(moved_unwatched(seconds(0)));
  for (int queries = 0; queries < 4; ++queries) {
    const KeyframeId query = take_query();
    const std::vector<LoopClosure> turned = places_.turned(submaps_, graph_, path());
    EXPECT_THAT(turned, Contains(Truly([&](const LoopClosure& match) {
                  return match.to == query && poses_near(graph_.T_map_keyframe[match.from] * match.T_from_to,
                                                         T_world(query), 0.5, radians(3.0));
                })))
        << queries;
  }
}

TEST_F(PlaceHypothesesTest, UnwatchedItTurnsByNoMoreThanAQuarter) {
  for (const double turn_rad : {radians(80.0), radians(100.0)}) {
    turn_travel(turn_rad);
    newest_ = since_;
    places_.begin(moved_unwatched(seconds(0)));
    take_query();
    propose(Pose2());
    EXPECT_EQ(places_.size(), turn_rad < kPi / 2.0 ? 2U : 1U) << turn_rad;
  }
}

TEST_F(PlaceHypothesesTest, TurnsAreAboutAKeyframeThatIsNotPruned) {
  places_.begin(moved_unwatched(seconds(0)));
  IdRanges<KeyframeId> pruned;
  pruned.add({since_ - 3, since_});
  places_.begin_again(pruned);
  for (KeyframeId k = since_ - 3; k < since_; ++k) graph_.T_map_keyframe[k] = kNowhere;
  take_query();
  EXPECT_THAT(places_.turned(submaps_, graph_, path()), Contains(Field(&LoopClosure::to, newest_)));
}

TEST_F(PlaceHypothesesTest, WhoWasCarriedIsNotLookedForAmongTurns) {
  places_.begin(carried_for(kLong));
  take_query();
  EXPECT_THAT(places_.turned(submaps_, graph_, path()), IsEmpty());
}

TEST_F(PlaceHypothesesTest, ResumedWhereTheGraphHasTheTravelNowIsOneMorePlace) {
  config_.tuning.places.max_sigma_m = kAny;
  put_travel(kNowhere);
  const KeyframePoses T_path_keyframe = path();  // no closure moves it
  const auto take = [&] {
    while (!places_.add_query(++newest_, recent(newest_), submaps_, graph_, run_.T_local_keyframe(),
                              T_path_keyframe)) {
    }
  };
  places_.begin(moved_unwatched(seconds(0)));
  take();
  put_travel(Pose2());
  take();
  EXPECT_EQ(places_.size(), 1U) << "a place stays, whatever the graph does";
  places_.resume();
  take();
  EXPECT_EQ(places_.size(), 2U);
  EXPECT_THAT(places_.decided(), SizeIs(3)) << "all the travel since the break is evidence for it";
  take();
  EXPECT_EQ(places_.size(), 2U) << "once";
}

TEST_F(PlaceHypothesesTest, BeginningAgainKeepsTheBreak) {
  put_travel(Pose2(10.0, 0.0, 0.0));
  places_.begin(carried_for(seconds(10), 100.0));
  take_query();
  places_.begin_again();
  EXPECT_EQ(places_.size(), 0U);
  EXPECT_THAT(places_.decided(), IsEmpty());
  take_query();
  propose(Pose2());
  ASSERT_EQ(places_.size(), 2U) << "as far as in ten seconds";
  EXPECT_GT(queries_until_decided(), 0) << "it was moved";
}

TEST_F(PlaceHypothesesTest, WhatTheCrossCheckRefusesCountsNothing) {
  config_.tuning.cross_check.min_share_on_walls = 1.1;
  places_.begin(carried_for(seconds(10)));
  EXPECT_EQ(queries_until_decided(), 0);
}

TEST_F(PlaceHypothesesTest, TheSamePlaceIsOneHypothesis) {
  put_travel(kNowhere);
  places_.begin(carried_for(kLong));
  propose(kNowhere);
  EXPECT_EQ(places_.size(), 0U) << "nothing was travelled yet";
  take_query();
  const auto turned = [&](double yaw_rad) {
    return kNowhere * T_world(newest_) * Pose2(0.0, 0.0, yaw_rad) * T_world(newest_).inverse();
  };
  propose(kNowhere * Pose2(0.6, 0.0, 0.0));
  propose(turned(0.15));
  EXPECT_EQ(places_.size(), 1U);
  propose(kNowhere * Pose2(0.8, 0.0, 0.0));
  EXPECT_EQ(places_.size(), 2U);
  propose(turned(0.25));
  EXPECT_EQ(places_.size(), 3U);
}

TEST_F(PlaceHypothesesTest, HypothesesThatComeTogetherAreOne) {
  put_travel(Pose2(0.4, 0.0, 0.0));
  places_.begin(carried_for(kLong));
  take_query();
  propose(Pose2(-0.4, 0.0, 0.0));
  ASSERT_EQ(places_.size(), 2U);
  take_queries(3);
  EXPECT_EQ(places_.size(), 1U) << "the walls draw both to the true place";
}

TEST_F(PlaceHypothesesTest, OnlySoManyHypothesesAreKept) {
  config_.tuning.places.max_hypotheses = 2;
  put_travel(kNowhere);
  places_.begin(carried_for(kLong, 100.0));
  take_query();
  propose(Pose2());
  propose(Pose2(0.0, 300.0, 0.0));
  EXPECT_EQ(places_.size(), 2U);
  EXPECT_GT(queries_until_decided(), 0) << "the likelier stay";
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesTest, OnlyNewTravelIsEvidence) {
  places_.begin(carried_for(seconds(10)));
  const KeyframeId first = take_query();
  EXPECT_GE(run_.chain().path_m(first) - run_.chain().path_m(since_), 2.0);
  EXPECT_FALSE(add(first));
  const KeyframeId second = take_query();
  EXPECT_GE(run_.chain().path_m(second) - run_.chain().path_m(first), 2.0);
  config_.min_match_points = 100'000;
  EXPECT_FALSE(add(run_.newest())) << "too few hits";
}

TEST_F(PlaceHypothesesTest, OldTravelIsForgotten) {
  config_.tuning.places.max_queries = 4;
  config_.tuning.places.max_sigma_m = kAny;
  places_.begin(carried_for(seconds(10)));
  take_queries(2);
  const KeyframeId third = take_query();
  take_queries(3);
  EXPECT_THAT(places_.decided(), AllOf(SizeIs(4), Each(Field(&LoopClosure::to, Ge(third)))));
}

TEST_F(PlaceHypothesesTest, SoIsItsEvidence) {
  config_.tuning.places.max_sigma_m = kAny;
  config_.tuning.places.places_per_submap = 1e9;  // more than three queries speak for
  begin_nowhere(100.0);
  EXPECT_GT(queries_until_decided(), 0);
  config_.tuning.places.max_queries = 3;
  begin_nowhere(100.0);
  EXPECT_EQ(queries_until_decided(), 0);
}

TEST_F(PlaceHypothesesTest, OneThatWasAcceptedIsBeyondDoubtOnceItLeadsByTwoDecisions) {
  begin_nowhere(100.0);
  ASSERT_GT(queries_until_decided(), 0);
  EXPECT_FALSE(places_.is_beyond_doubt()) << "nothing was accepted";
  accept(Pose2());
  EXPECT_THAT(places_.decided(), IsEmpty());
  EXPECT_FALSE(places_.is_beyond_doubt());
  int more = 0;
  for (; !places_.is_beyond_doubt() && more < 10; ++more) take_query();
  EXPECT_GT(more, 0);
  EXPECT_LT(more, 4) << "a query gives five of the seven nats of a decision";
}

TEST_F(PlaceHypothesesTest, OneThatWasAcceptedIsRefutedByAsMuchAsItTakesToAcceptIt) {
  begin_nowhere(100.0);
  ASSERT_GT(queries_until_decided(), 0);
  accept(Pose2());
  EXPECT_FALSE(places_.is_refuted());
  change_cells(
      [](std::uint8_t occupied) { return static_cast<std::uint8_t>(occupied == 0 ? 0 : 255 - occupied); });
  int queries = 0;
  for (; !places_.is_refuted() && queries < 20; ++queries) take_query();
  EXPECT_GE(queries, 2);
  EXPECT_LT(queries, 20);
}

TEST_F(PlaceHypothesesTest, OneThatWasAcceptedLiesWhereTheGraphHasTheTravel) {
  begin_nowhere(100.0);
  ASSERT_GT(queries_until_decided(), 0);
  accept(Pose2());
  for (KeyframeId k = newest_ + 1; k <= run_.newest(); ++k)  // closures have corrected the graph since
    (*path_)[k] = Pose2(1.0, 1.0, 0.0) * path()[k];
  take_queries(3);
  EXPECT_TRUE(places_.is_beyond_doubt());
}

/// The corridor stands on the map twice, 40 m apart, flown in two laps.
class PlaceHypothesesOfTwoAlikeTest : public PlaceHypothesesTest {
 protected:
  PlaceHypothesesOfTwoAlikeTest()
      : PlaceHypothesesTest(BrokenFlight::along(loop_corridor(), "abcdabcda", "abcd")) {
    while (run_.chain().path_m(second_lap_) < kLapM) ++second_lap_;
    for (KeyframeId k = second_lap_; k < since_; ++k) graph_.T_map_keyframe[k] = twin_ * T_world(k);
    put_travel(kNowhere);
  }
  [[nodiscard]] int queries_until_decided_between_both() {
    return queries_until_decided_between_both(carried_for(kLong, 100.0));
  }
  [[nodiscard]] int queries_until_decided_between_both(const MotionBreak& motion_break) {
    places_.begin(motion_break);
    newest_ = since_;
    take_query();
    propose(Pose2());
    propose(twin_);
    EXPECT_EQ(places_.size(), 3U);
    return queries_until_decided();
  }

  static constexpr double kLapM = 38.0;
  const Pose2 twin_{40.0, 0.0, 0.0};
  KeyframeId second_lap_{};
};

TEST_F(PlaceHypothesesOfTwoAlikeTest, StayUndecided) { EXPECT_EQ(queries_until_decided_between_both(), 0); }

TEST_F(PlaceHypothesesOfTwoAlikeTest, ATurnIsLikelierThanToHaveMovedFar) {
  graph_.T_map_keyframe[since_ - 1] = T_world(since_ - 1);
  turn_travel(radians(50.0));
  EXPECT_GT(queries_until_decided_between_both(moved_unwatched(kLong, 100.0)), 0);
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesOfTwoAlikeTest, AreDecidedWhereOneOfThemIsNotMapped) {
  map(KeyframeId{}, second_lap_);
  EXPECT_GT(queries_until_decided_between_both(), 0);
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesOfTwoAlikeTest, WhatToldThemApartIsNotForgotten) {
  config_.tuning.places.max_queries = 4;
  const auto both = submaps_;
  map(KeyframeId{}, second_lap_);
  ASSERT_GT(queries_until_decided_between_both(), 0);
  const KeyframeId last_that_tells = newest_;
  submaps_ = both;
  take_queries(4);
  EXPECT_THAT(places_.decided(), AllOf(SizeIs(4), Each(Field(&LoopClosure::to, Gt(last_that_tells)))));
  expect_true(places_.decided());
}

TEST_F(PlaceHypothesesOfTwoAlikeTest, TheTwinIsOvertakenWhereItsGroundIsOtherwise) {
  const auto both = submaps_;
  map(second_lap_, since_);
  put_travel(Pose2());  // it has not moved, and nothing around is mapped
  places_.begin(carried_for(kLong, 10.0));
  newest_ = since_;
  take_query();
  propose(twin_);
  ASSERT_GT(queries_until_decided(), 0);
  for (const LoopClosure& match : places_.decided()) ASSERT_GE(match.from, second_lap_);
  accept(twin_);
  change_cells([](std::uint8_t occupied) { return static_cast<std::uint8_t>(255 - occupied); });
  submaps_.insert(submaps_.begin(), both.begin(), both.begin() + 8);
  ASSERT_LT(submaps_[7]->reference, second_lap_);
  EXPECT_GT(queries_until_decided(), 0);
  expect_true(places_.decided());
}

/// Dead reckoning counts a metre as 1.1 m.
class PlaceHypothesesWithDriftTest : public PlaceHypothesesTest {
 protected:
  PlaceHypothesesWithDriftTest() : PlaceHypothesesTest(round_the_corridor(), 1.1) {}
};

TEST_F(PlaceHypothesesWithDriftTest, NotHavingMovedFollowsTheGraphOverNewGround) {
  config_.tuning.places.max_sigma_m = kAny;
  places_.begin(carried_for(seconds(10)));
  const auto mapped = std::exchange(submaps_, {});
  take_queries(4);  // 8 m: dead reckoning is 0.8 m off, the graph has learnt its scale
  submaps_ = mapped;
  take_queries(3);
  EXPECT_THAT(places_.decided(), SizeIs(3));
}

TEST_F(PlaceHypothesesWithDriftTest, AHypothesisFollowsTheDrift) {
  places_.begin(carried_for(seconds(10)));
  take_queries(7);  // 14 m: 1.4 m off
  ASSERT_THAT(places_.decided(), SizeIs(7));
  const LoopClosure newest = places_.decided().back();
  EXPECT_TRUE(poses_near(graph_.T_map_keyframe[newest.from] * newest.T_from_to, T_world(newest.to), 0.5,
                         radians(5.0)));
}

}  // namespace
}  // namespace swiftlet
