// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/viewer.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

std::uint32_t u32_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

/// Takes messages until there are no more; what they hold, as a page would keep it.
struct ReadingPage {
  std::vector<std::string> types;
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> tile_versions;
  std::size_t poses = 0;
  std::size_t most_bytes = 0;

  void read_all(Viewer& viewer) {
    while (const auto message = viewer.next()) read(*message);
  }
  void read(const WebMessage& message) {
    most_bytes = std::max(most_bytes, message.bytes.size());
    if (message.is_text) return types.push_back(nlohmann::json::parse(message.bytes)["type"]);
    const std::uint32_t kind = u32_at(message.bytes, 0);
    const std::uint32_t count = u32_at(message.bytes, 4);
    types.push_back(kind == kPosesKind ? "poses" : kind == kWallsKind ? "walls" : "tiles");
    if (kind == kPosesKind) poses += count;
    for (std::uint32_t i = 0; kind == kTilesKind && i < count; ++i) {
      const std::size_t offset = 16 + i * (12 + kCellsInTile);
      tile_versions[{static_cast<std::int32_t>(u32_at(message.bytes, offset)),
                     static_cast<std::int32_t>(u32_at(message.bytes, offset + 4))}] =
          u32_at(message.bytes, offset + 8);
    }
  }
};

class ViewerTest : public testing::Test {
 protected:
  SharedRunHistory shared_;
  ShownSource live_{.title = "test", .is_recording = false, .rate = 1.0};
  RunHistory& history_ = shared_.history;

  void begin_run(std::int64_t map_id = 1) { ASSERT_TRUE(history_.enter_run(map_id, 0.0)); }
};

TEST_F(ViewerTest, BeforeTheFirstRunNothingIsSaid) {
  Viewer viewer(shared_, live_);
  EXPECT_FALSE(viewer.next());
}

TEST_F(ViewerTest, ALatePageIsToldEverythingAndThenNothing) {
  begin_run();
  for (int i = 0; i < 300; ++i) history_.add_tile(1, uniform_tile({i, -i}, 1, 40), 0.05);
  for (int i = 0; i < 10'000; ++i) add_whole_pose(history_, i, i);
  history_.add_status({.utime_us = 1});
  history_.add_event(1, EventLevel::kNote, "first");
  history_.add_closure({.index = 1}, false, 1);
  history_.add_walls(1, {{.id = 1, .start = {}, .end = {}}});
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  EXPECT_EQ(page.types.front(), "run");
  EXPECT_EQ(page.types.back(), "synced");
  EXPECT_EQ(
      std::set<std::string>(page.types.begin(), page.types.end()),
      (std::set<std::string>{"run", "status", "poses", "events", "closures", "walls", "tiles", "synced"}));
  EXPECT_EQ(page.tile_versions.size(), 300U);
  EXPECT_EQ(page.poses, 10'000U);
  EXPECT_LT(page.most_bytes, 400'000U);
  EXPECT_FALSE(viewer.next());
}

TEST_F(ViewerTest, APoseGoesWithItsBeams) {
  begin_run();
  history_.add_pose({.sequence = 1});
  history_.add_ranges(1, {0.0F, 1.0F}, {1.5F, 2.5F});
  history_.add_local(1, {});
  history_.add_odom(1, {});
  add_whole_pose(history_, 2, 2);
  Viewer viewer(shared_, live_);
  ASSERT_TRUE(viewer.next());
  const auto message = viewer.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->bytes.size(), 16U + 8 + 2 * (88 + 8));
  const auto f32_at = [&](std::size_t offset) {
    float number = 0.0F;
    std::memcpy(&number, message->bytes.data() + offset, sizeof number);
    return number;
  };
  EXPECT_EQ(f32_at(16 + 4), 1.0F) << "the second bearing";
  EXPECT_EQ(f32_at(16 + 8 + 88 + 4), 2.5F);
  EXPECT_EQ(f32_at(16 + 8 + 2 * 96 - 4), -1.0F) << "a pose without ranges";
}

TEST_F(ViewerTest, ASlowPageGetsTheNewestVersionAndNoneBetween) {
  begin_run();
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  for (std::uint32_t version = 1; version <= 1000; ++version)
    history_.add_tile(version * kSecondUs, uniform_tile({0, 0}, version, 40), 0.05);
  page.types.clear();
  page.read_all(viewer);
  EXPECT_EQ(page.types, (std::vector<std::string>{"tiles", "synced"}));
  EXPECT_EQ(page.tile_versions.at({0, 0}), 1000U);
}

TEST_F(ViewerTest, ANewRunBeginsAnew) {
  begin_run(1);
  history_.add_tile(1, uniform_tile({0, 0}, 7, 40), 0.05);
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  begin_run(2);
  history_.add_tile(1, uniform_tile({0, 0}, 7, 40), 0.05);
  page.types.clear();
  page.read_all(viewer);
  EXPECT_EQ(page.types, (std::vector<std::string>{"run", "tiles", "synced"}));
}

TEST_F(ViewerTest, LookingBackTakesTilesAwayAndLookingOnBringsThemAgain) {
  begin_run();
  history_.add_tile(10 * kSecondUs, uniform_tile({0, 0}, 1, 40), 0.05);
  history_.add_tile(20 * kSecondUs, uniform_tile({0, 0}, 2, 40), 0.05);
  history_.add_tile(20 * kSecondUs, uniform_tile({1, 0}, 1, 40), 0.05);
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  viewer.take(R"({"at": 15000000})");
  page.read_all(viewer);
  EXPECT_EQ(page.tile_versions.at({0, 0}), 1U);
  EXPECT_EQ(page.tile_versions.at({1, 0}), 0U);
  viewer.take(R"({"at": null})");
  page.read_all(viewer);
  EXPECT_EQ(page.tile_versions.at({0, 0}), 2U);
  EXPECT_EQ(page.tile_versions.at({1, 0}), 1U);
}

TEST_F(ViewerTest, ShowsTheStoreyThatIsLookedAt) {
  begin_run();
  history_.add_tile(kSecondUs, uniform_tile({0, 0}, 5, 40), 0.05);
  history_.add_tile(kSecondUs, uniform_tile({0, 0, StoreyId{1}}, 7, 60), 0.05);
  history_.add_walls(kSecondUs, {{.id = 1}, {.id = 2, .storey = 1}, {.id = 3, .storey = 1}});
  history_.add_pose({.utime_us = kSecondUs});
  history_.add_pose({.utime_us = 2 * kSecondUs, .sequence = 1, .storey = 1});
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  EXPECT_EQ(page.tile_versions.at({0, 0}), 7U);
  EXPECT_EQ(history_.walls_at({}, StoreyId{1}).size(), 2U);
  page.types.clear();
  viewer.take(R"({"at": 1500000})");
  page.read_all(viewer);
  EXPECT_EQ(page.types, (std::vector<std::string>{"storey", "walls", "tiles", "synced"}));
  EXPECT_EQ(page.tile_versions.at({0, 0}), 5U);
}

TEST_F(ViewerTest, TheFinalStatusIsSaidAlthoughItsTimeIsTheOneBefore) {
  begin_run();
  history_.add_status({.utime_us = 5, .state = 0});
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  history_.add_status({.utime_us = 5, .state = 2});
  const auto message = viewer.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(nlohmann::json::parse(message->bytes)["state"], 2);
}

TEST_F(ViewerTest, APageThatLooksBackIsToldOfTheEnd) {
  begin_run();
  history_.add_status({.utime_us = 5, .state = 0});
  Viewer viewer(shared_, live_);
  viewer.take(R"({"at": 5})");
  const auto has_ended = [&viewer] {
    std::string last;
    while (const auto message = viewer.next()) last = message->bytes;
    return nlohmann::json::parse(last)["has_ended"];
  };
  EXPECT_EQ(has_ended(), false);
  history_.add_status({.utime_us = 7, .state = 2});
  EXPECT_EQ(has_ended(), true);
}

TEST_F(ViewerTest, ARecordingBeginsAtItsBeginning) {
  const ShownSource recording{.title = "a.pcap", .is_recording = true, .rate = 5.0};
  begin_run();
  history_.add_tile(10 * kSecondUs, uniform_tile({0, 0}, 1, 40), 0.05);
  Viewer viewer(shared_, recording);
  ReadingPage page;
  page.read_all(viewer);
  EXPECT_TRUE(page.tile_versions.empty());
}

TEST_F(ViewerTest, WhatIsNoRequestChangesNothing) {
  begin_run();
  Viewer viewer(shared_, live_);
  ReadingPage page;
  page.read_all(viewer);
  for (const char* text :
       {"", "[]", "7", R"({"at": "x"})", R"({"at": 1e300})", R"({"to": 3})", "{\"at\":", "\xff"})
    viewer.take(text);
  EXPECT_FALSE(viewer.next());
}

}  // namespace
}  // namespace swiftlet
