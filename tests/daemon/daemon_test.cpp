// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/daemon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "tests/support/manual_clock.hpp"
#include "tests/support/recording_publisher.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

std::set<std::string> thread_names() {
  std::set<std::string> names;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream comm(task.path() / "comm");
    std::string name;
    std::getline(comm, name);
    names.insert(name);
  }
  return names;
}

std::vector<double> poses_of(const Backend& backend) {
  std::vector<double> out;
  for (const auto& [id, scan] : backend.scans().all()) {
    const Pose2 T_map_body = backend.T_map_body(id);
    out.insert(out.end(), {T_map_body.x_m(), T_map_body.y_m(), T_map_body.yaw_rad()});
  }
  return out;
}

TEST(Daemon, InThreadsComesToTheSamePosesAsInLockstep) {
  const std::vector<RangeSample> flight = flight_in_square_room(600, 2.5, 1.5);
  ScriptedSampleSource for_lockstep(flight);
  Pipeline lockstep(Configuration{}, for_lockstep);
  for (bool more = true; more;) {
    const Result<bool> step = lockstep.step();
    ASSERT_TRUE(step);
    more = *step;
  }
  ScriptedSampleSource source(flight);
  ManualClock clock;
  RecordingPublisher publisher;
  Daemon daemon(Configuration{}, source, clock, {.rate = 1.0}, publisher);
  ASSERT_TRUE(daemon.run(std::stop_token{}));
  EXPECT_EQ(poses_of(daemon.pipeline().backend()), poses_of(lockstep.backend()));
}

TEST(Daemon, AConsumerHoldsTheDaemonsOwnMapAtTheEnd) {
  ScriptedSampleSource source(flight_in_square_room(400, 2.5, 1.5));
  SteadyClock clock;
  RecordingPublisher publisher;
  Daemon daemon(Configuration{}, source, clock, {.rate = 2000.0}, publisher);
  ASSERT_TRUE(daemon.run(std::stop_token{}));
  const MapBuilder& map = daemon.pipeline().map();
  ASSERT_FALSE(map.tiles().empty());
  for (const TileIndex index : map.tiles()) EXPECT_TRUE(publisher.newest.contains(index));
  std::uint64_t version_sum = 0;
  for (const auto& [index, tile] : publisher.newest) {
    EXPECT_EQ(tile.occupancy_percent, map.tile(index).occupancy_percent);
    version_sum += tile.version;
  }
  const DaemonStatus& last = publisher.statuses.back();
  EXPECT_EQ(last.state, DaemonState::kFinished);
  EXPECT_EQ(last.map.tiles, publisher.newest.size());
  EXPECT_EQ(last.map.version_sum, version_sum);
  EXPECT_EQ(last.backend.scans, 400U);
  EXPECT_EQ(publisher.poses.size() + last.queues[2].refused, 400U);
}

TEST(Daemon, ItsThreadsCarryTheirNames) {
  ScriptedSampleSource source(flight_in_square_room(15'000, 2.5, 1.5));  // lasts half a minute
  SteadyClock clock;
  RecordingPublisher publisher;
  const auto has_all = testing::IsSupersetOf({"radio", "frontend", "backend", "publisher"});
  std::stop_source stop;
  std::set<std::string> seen;
  publisher.on_pose = [&] {
    seen.merge(thread_names());
    if (testing::Value(seen, has_all)) stop.request_stop();
  };
  Daemon daemon(Configuration{}, source, clock, {.rate = 50.0}, publisher);
  ASSERT_TRUE(daemon.run(stop.get_token()));
  EXPECT_THAT(seen, has_all);
}

TEST(Daemon, WhenToldToStopWorksOffWhatItHasAndPublishesTheMap) {
  ScriptedSampleSource source(flight_in_square_room(10'000, 2.5, 1.5));  // lasts ten seconds
  SteadyClock clock;
  RecordingPublisher publisher;
  std::stop_source stop;
  publisher.on_pose = [&] {
    if (publisher.poses.size() == 20) stop.request_stop();
  };
  Daemon daemon(Configuration{}, source, clock, {.rate = 100.0}, publisher);
  ASSERT_TRUE(daemon.run(stop.get_token()));
  EXPECT_GE(daemon.pipeline().backend().counters().scans, 20U);
  EXPECT_LT(daemon.pipeline().backend().counters().scans, 10'000U) << "the whole flight";
  EXPECT_EQ(publisher.statuses.back().state, DaemonState::kFinished);
  for (const TileIndex index : daemon.pipeline().map().tiles()) EXPECT_TRUE(publisher.newest.contains(index));
}

TEST(Daemon, SaysWhatEndedTheInputBeforeItsTime) {
  ScriptedSampleSource source(flight_in_square_room(30, 2.5, 1.5), {ErrorCode::kNotFound, "gone"});
  ManualClock clock;
  RecordingPublisher publisher;
  Daemon daemon(Configuration{}, source, clock, {.rate = 1.0}, publisher);
  const Status outcome = daemon.run(std::stop_token{});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().message, "gone");
  EXPECT_EQ(daemon.pipeline().backend().counters().scans, 30U);
}

}  // namespace
}  // namespace swiftlet
