// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/run_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "swiftlet/status_t.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

TEST(RunHistory, ANewRunForgetsTheOldOne) {
  RunHistory history;
  EXPECT_TRUE(history.enter_run(7, 0.0));
  history.add_tile(1, uniform_tile({0, 0}, 3, 50), 0.05);
  add_whole_pose(history, 1, 0);
  const std::uint64_t changes = history.changes();
  EXPECT_TRUE(history.enter_run(8, 0.0));
  EXPECT_TRUE(history.tiles().empty());
  EXPECT_TRUE(history.poses_after(0).empty());
  EXPECT_EQ(history.generation(), 2U);
  EXPECT_GT(history.changes(), changes);
}

TEST(RunHistory, ALateMessageOfAnOlderRunIsNotBelievedUnlessTheNewerOneIsSilent) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(8, 0.0));
  EXPECT_FALSE(history.enter_run(7, 0.1));
  EXPECT_EQ(history.map_id(), 8);
  EXPECT_TRUE(history.enter_run(7, 6.0));
  EXPECT_EQ(history.map_id(), 7);
}

TEST(RunHistory, IsFinishedFromTheStatusOnThatSaysSo) {
  RunHistory history;
  EXPECT_FALSE(history.is_finished_at(std::nullopt));
  history.add_status({.utime_us = 10, .state = status_t::STATE_FINISHING});
  history.add_status({.utime_us = 20, .state = status_t::STATE_FINISHED});
  EXPECT_TRUE(history.is_finished_at(std::nullopt));
  EXPECT_FALSE(history.is_finished_at(9));
  EXPECT_FALSE(history.is_finished_at(19));
  EXPECT_TRUE(history.is_finished_at(20));
}

TEST(RunHistory, ATileIsFoundAsItWas) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  history.add_tile(10 * kSecondUs, uniform_tile({2, -1}, 1, 20), 0.05);
  history.add_tile(20 * kSecondUs, uniform_tile({2, -1}, 2, 80), 0.05);
  const auto& versions = history.tiles().at({2, -1});
  EXPECT_EQ(versions.at(9 * kSecondUs), nullptr);
  EXPECT_THAT(inflate_tile(value_of(versions.at(15 * kSecondUs)).deflated), testing::Each(20));
  EXPECT_THAT(inflate_tile(value_of(versions.newest()).deflated), testing::Each(80));
}

TEST(RunHistory, AnOlderVersionOfATileChangesNothing) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  history.add_tile(1, uniform_tile({0, 0}, 5, 20), 0.05);
  const std::uint64_t changes = history.changes();
  history.add_tile(2, uniform_tile({0, 0}, 4, 80), 0.05);
  history.add_tile(3, uniform_tile({0, 0}, 5, 80), 0.05);
  EXPECT_EQ(history.changes(), changes);
}

TEST(RunHistory, OfAllTooManyRangesTheOldestAreForgotten) {
  RunHistory history(HistoryLimits{.ranges = 40});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (int i = 0; i < 11; ++i) {
    history.add_pose({.utime_us = i, .sequence = i});
    history.add_ranges(i, {0.0F, 1.0F, 2.0F, 3.0F}, {1.0F, 2.0F, 3.0F, 4.0F});
    history.add_local(i, {});
    history.add_odom(i, {});
  }
  const auto poses = history.poses_after(0);
  ASSERT_EQ(poses.size(), 11U);
  EXPECT_TRUE(poses.front().ranges_m.empty());
  EXPECT_THAT(poses.back().ranges_m, testing::SizeIs(4));
}

TEST(RunHistory, RangesOfPosesThatAreThinnedDoNotCount) {
  RunHistory history(HistoryLimits{.poses = 10, .ranges = 20});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (int i = 0; i < 1000; ++i) {
    history.add_pose({.utime_us = i, .sequence = i});
    history.add_ranges(i, {0.0F, 1.0F}, {1.0F, 2.0F});
    history.add_local(i, {});
    history.add_odom(i, {});
  }
  for (const TrailPose& pose : history.poses_after(0)) EXPECT_THAT(pose.ranges_m, testing::SizeIs(2));
}

TEST(RunHistory, RangesAlongOtherBeamsThanTheRunsAreNotBelieved) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  add_whole_pose(history, 1, 1);
  history.add_ranges(1, {0.0F, 1.0F}, {1.0F, 2.0F});
  add_whole_pose(history, 2, 2);
  history.add_ranges(2, {0.0F, 2.0F}, {1.0F, 2.0F});
  history.add_ranges(2, {0.0F, 1.0F}, {1.0F});
  EXPECT_TRUE(history.poses_after(1).front().ranges_m.empty());
}

TEST(RunHistory, WhatIsNoTileOfOursIsUnknown) { EXPECT_THAT(inflate_tile({}), testing::Each(-1)); }

TEST(RunHistory, APoseIsShownInAllItsFrames) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  history.add_pose({.utime_us = 5, .sequence = 0, .map = {1.0, 2.0, 0.5}});
  history.add_odom(0, {3.0, 4.0, 0.25});
  EXPECT_TRUE(history.poses_after(0).empty());
  history.add_local(0, {2.0, 3.0, 0.5});
  ASSERT_EQ(history.poses_after(0).size(), 1U);
  EXPECT_EQ(history.poses_after(0).front().odom[1], 4.0);
  history.add_odom(9, {8.0, 8.0, 8.0});
  EXPECT_EQ(history.poses_after(0).front().odom[1], 4.0);
}

TEST(RunHistory, APoseOfWhichOneFrameIsLostIsLeftOutNotThoseAroundIt) {
  for (const bool has_local : {true, false}) {
    RunHistory history;
    ASSERT_TRUE(history.enter_run(1, 0.0));
    add_whole_pose(history, 0, 0);
    history.add_pose({.utime_us = 1, .sequence = 1});
    if (has_local) history.add_local(1, {3.0, 4.0, 0.25});
    if (!has_local) history.add_odom(1, {3.0, 4.0, 0.25});
    EXPECT_EQ(history.poses_after(0).size(), 1U) << "the newest is waited for";
    add_whole_pose(history, 2, 2);
    const auto poses = history.poses_after(0);
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_EQ(poses[0].sequence, 0);
    EXPECT_EQ(poses[1].sequence, 2);
    EXPECT_EQ(history.poses_after(poses[0].serial).front().sequence, 2);
  }
}

TEST(RunHistory, AnHourOfPosesTakesBoundedRoomAndKeepsItsBeginning) {
  RunHistory history({.poses = 1000});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (int i = 0; i < 36'000; ++i) add_whole_pose(history, i * kSecondUs / 10, i);
  const auto poses = history.poses_after(0);
  EXPECT_LE(poses.size(), 1000U);
  EXPECT_GE(poses.size(), 500U);
  EXPECT_EQ(poses.front().sequence, 0);
  EXPECT_EQ(poses.back().sequence, 35'999);
  EXPECT_EQ(history.poses_after(poses.back().serial).size(), 0U);
}

TEST(RunHistory, TilesThatChangeForHoursTakeBoundedRoom) {
  RunHistory history({.tile_bytes = 20'000});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (std::uint32_t version = 1; version < 5000; ++version)
    history.add_tile(version * kSecondUs,
                     uniform_tile({0, 0}, version, static_cast<std::int8_t>(version % 100)), 0.05);
  EXPECT_LE(history.tile_bytes(), 20'000U);
  EXPECT_EQ(value_of(history.tiles().at({0, 0}).newest()).version, 4999U);
  EXPECT_NE(history.tiles().at({0, 0}).at(kSecondUs), nullptr);
}

TEST(RunHistory, AMapBeyondAllBuildingsIsRefused) {
  RunHistory history({.tiles = 2});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (int x = 0; x < 5; ++x) history.add_tile(1, uniform_tile({x, 0}, 1, 50), 0.05);
  history.add_tile(2, uniform_tile({1, 0}, 2, 50), 0.05);
  EXPECT_EQ(history.tiles().size(), 2U);
  EXPECT_EQ(value_of(history.tiles().at({1, 0}).newest()).version, 2U);
}

TEST(RunHistory, AClosureKeepsWhenItWasFoundAndWhenItWasDropped) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  history.add_closure({.index = 4}, false, 100);
  const std::uint64_t change = history.closures().at(4).change;
  history.add_closure({.index = 4}, true, 900);
  EXPECT_EQ(history.closures().at(4).closure.found_us, 100);
  EXPECT_EQ(history.closures().at(4).closure.dropped_us, 900);
  EXPECT_GT(history.closures().at(4).change, change);
}

TEST(RunHistory, WallsThatStayAreNotKeptTwice) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(1, 0.0));
  history.add_walls(1, {{.id = 1, .start = {0.0F, 0.0F}, .end = {1.0F, 0.0F}}});
  history.add_walls(2, {{.id = 1, .start = {0.0F, 0.0F}, .end = {1.0F, 0.0F}}});
  EXPECT_EQ(history.walls().size(), 1U);
}

TEST(RunHistory, EventsBeyondTheLimitForgetTheOldest) {
  RunHistory history({.events = 10});
  ASSERT_TRUE(history.enter_run(1, 0.0));
  for (int i = 0; i < 100; ++i) history.add_event(i, EventLevel::kNote, std::to_string(i));
  EXPECT_LE(history.events_after(0).size(), 10U);
  EXPECT_EQ(history.events_after(0).back().text, "99");
}

}  // namespace
}  // namespace swiftlet
