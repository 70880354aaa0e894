// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_publisher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <limits>

#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_info_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/mbot_lidar_t.hpp"
#include "swiftlet/mbot_occupancy_grid_t.hpp"
#include "swiftlet/pose2d_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"

namespace swiftlet {
namespace {

constexpr std::int64_t kMapId = 1'700'000'000'000'000;
const HostTime kNow{std::chrono::seconds(1'700'000'001)};
constexpr std::int64_t kNowUtime = 1'700'000'001'000'000;

/// Publishes into a log file of LCM's own and reads back what arrived there.
class LcmPublisherTest : public testing::Test {
 protected:
  LcmPublisherTest()
      : path_(testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".lcm") {}
  ~LcmPublisherTest() override { std::filesystem::remove(path_); }
  LcmPublisherTest(const LcmPublisherTest&) = delete;
  LcmPublisherTest& operator=(const LcmPublisherTest&) = delete;

  template <typename Publish>
  void publish(Publish&& publish_some, const std::string& prefix = "T_", Compatibility compatibility = {}) {
    const auto lcm = LcmTransport::open("file://" + path_ + "?mode=w");
    ASSERT_TRUE(lcm) << lcm.error().message;
    publish_some(*make_lcm_publisher(**lcm, prefix, kMapId, {}, compatibility));
  }

  /// The messages on `channel`, in order.
  template <typename Message>
  std::vector<Message> received(const std::string& channel) {
    std::vector<Message> out;
    lcm::LogFile log(path_, "r");
    while (const lcm::LogEvent* event = log.readNextEvent()) {
      EXPECT_LE(event->channel.size() + 1 + static_cast<std::size_t>(event->datalen), kMaxLcmMessageBytes);
      if (event->channel != channel) continue;
      EXPECT_EQ(out.emplace_back().decode(event->data, 0, event->datalen), event->datalen);
    }
    return out;
  }

 private:
  std::string path_;
};

TEST_F(LcmPublisherTest, SaysWhereTheVehicleIsInEveryFrame) {
  publish([](Publisher& publisher) {
    publisher.publish_pose({.stamp = kNow,
                            .sequence = 7,
                            .segment = 2,
                            .keyframe = KeyframeId{3},
                            .correction_version = 5,
                            .correction_m = 0.75,
                            .T_map_body = Pose2(1.0, 2.0, 0.5),
                            .T_local_body = Pose2(3.0, 4.0, 0.25),
                            .T_odom_body = Pose2(-1.0, -2.0, -0.5),
                            .tracking = Tracking::kRelocalizing,
                            .from_start = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6},
                            .from_surroundings = {1.1, 1.2, 1.3, 1.4, 1.5, 1.6}});
  });
  const auto map = received<pose_t>("T_POSE");
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0].utime, kNowUtime);
  EXPECT_EQ(map[0].map_id, kMapId);
  EXPECT_EQ(map[0].sequence, 7);
  EXPECT_EQ(map[0].segment, 2);
  EXPECT_EQ(map[0].keyframe, 3);
  EXPECT_EQ(map[0].correction_version, 5);
  EXPECT_EQ(map[0].correction, 0.75);
  EXPECT_EQ(map[0].frame, pose_t::FRAME_MAP);
  EXPECT_EQ(map[0].y, 2.0);
  EXPECT_EQ(map[0].tracking, pose_t::TRACKING_RELOCALIZING);
  EXPECT_THAT(map[0].covariance_start, testing::ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
  EXPECT_THAT(map[0].covariance_map, testing::ElementsAre(1.1, 1.2, 1.3, 1.4, 1.5, 1.6));
  EXPECT_THAT(received<pose_t>("T_POSE_LOCAL").at(0).covariance_start, testing::Each(0.0));
  EXPECT_EQ(received<pose_t>("T_POSE_LOCAL").at(0).x, 3.0);
  EXPECT_EQ(received<pose_t>("T_POSE_LOCAL").at(0).frame, pose_t::FRAME_LOCAL);
  EXPECT_EQ(received<pose_t>("T_POSE_ODOM").at(0).yaw, -0.5);
  EXPECT_EQ(received<pose_t>("T_POSE_ODOM").at(0).frame, pose_t::FRAME_ODOM);
  EXPECT_EQ(received<pose2d_t>("T_POSE_2D").at(0).theta, 0.5F);
  EXPECT_EQ(received<pose2d_t>("T_POSE_ODOM_2D").at(0).x, -1.0F);
}

TEST_F(LcmPublisherTest, TheBeamsGoWithThePoseInWhichTheyWereMeasured) {
  BeamReadings beams = BeamReadings::of({3, {0.0, 0.5, -0.5}}, SensorModel::crazyflie());
  beams.distance_m = {1.5F, 0.0F, 0.0F};
  beams.status = {RangeStatus::kHit, RangeStatus::kNoReturn, RangeStatus::kInvalid};
  publish([&](Publisher& publisher) {
    publisher.publish_pose({.stamp = kNow,
                            .sequence = 7,
                            .measured_at = DeviceTime(std::chrono::milliseconds(250)),
                            .beams = beams});
  });
  const auto messages = received<ranges_t>("T_RANGES");
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].utime, kNowUtime);
  EXPECT_EQ(messages[0].map_id, kMapId);
  EXPECT_EQ(messages[0].sequence, 7);
  EXPECT_EQ(messages[0].device_utime, 250'000);
  EXPECT_EQ(messages[0].max_range, 3.0F);
  EXPECT_EQ(messages[0].count, 3);
  EXPECT_THAT(messages[0].bearing, testing::ElementsAre(0.0F, 0.5F, -0.5F));
  EXPECT_THAT(messages[0].distance, testing::ElementsAre(1.5F, 0.0F, 0.0F));
  EXPECT_THAT(messages[0].status, testing::ElementsAre(ranges_t::STATUS_HIT, ranges_t::STATUS_NO_RETURN,
                                                       ranges_t::STATUS_INVALID));
}

TEST_F(LcmPublisherTest, ATileArrivesAsItWasDrawn) {
  MapTile tile{.index = {-3, 4, StoreyId{2}}, .version = 9};
  for (std::size_t i = 0; i < tile.occupancy_percent.size(); ++i)
    tile.occupancy_percent[i] = static_cast<std::int8_t>(static_cast<int>(i % 102) - 1);
  publish([&](Publisher& publisher) { publisher.publish_tile(kNow, tile, 0.05); });
  const auto messages = received<map_tile_t>("T_MAP_TILE");
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].tile_x, -3);
  EXPECT_EQ(messages[0].tile_y, 4);
  EXPECT_EQ(messages[0].storey, 2);
  EXPECT_EQ(messages[0].version, 9);
  EXPECT_EQ(messages[0].resolution, 0.05);
  for (std::size_t row = 0; row < kTileCells; ++row) {
    for (std::size_t column = 0; column < kTileCells; ++column)
      ASSERT_EQ(messages[0].occupancy_percent[row][column],
                tile.occupancy_percent[row * kTileCells + column]);
  }
}

TEST_F(LcmPublisherTest, SaysWhatTheTilesCover) {
  publish([](Publisher& publisher) {
    publisher.publish_map(
        kNow, {.resolution_m = 0.05, .tiles = 6, .version_sum = 44, .lowest = {-1, -2}, .highest = {3, 4}});
  });
  const map_info_t info = received<map_info_t>("T_MAP_INFO").at(0);
  EXPECT_EQ(info.tile_cells, 64);
  EXPECT_EQ(info.tile_count, 6);
  EXPECT_EQ(info.version_sum, 44);
  EXPECT_EQ(info.tile_min[1], -2);
  EXPECT_EQ(info.tile_max[0], 3);
}

TEST_F(LcmPublisherTest, ManyWallsAreSpreadOverSeveralMessages) {
  std::vector<WallInMap> walls(kMaxWallsPerMessage * 2 + 1);
  for (std::uint32_t i = 0; i < walls.size(); ++i)
    walls[i] = {LandmarkId{i}, {static_cast<double>(i), 1.0}, {2.0, 3.0}, StoreyId{1}};
  publish([&](Publisher& publisher) { publisher.publish_walls(kNow, walls); });
  const auto messages = received<landmarks_t>("T_LANDMARKS");
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].total, 2001);
  EXPECT_EQ(messages[1].first, 1000);
  EXPECT_EQ(messages[2].count, 1);
  EXPECT_EQ(messages[2].landmarks.at(0).id, 2000);
  EXPECT_EQ(messages[2].landmarks.at(0).storey, 1);
  EXPECT_EQ(messages[2].landmarks.at(0).start[0], 2000.0F);
}

TEST_F(LcmPublisherTest, NoWallsAreSaidToo) {
  publish([](Publisher& publisher) { publisher.publish_walls(kNow, {}); });
  EXPECT_EQ(received<landmarks_t>("T_LANDMARKS").at(0).total, 0);
}

TEST_F(LcmPublisherTest, AClosureCarriesItsUncertaintyAndItsEnds) {
  publish([](Publisher& publisher) {
    publisher.publish_closure(kNow, {.closure = {.id = ClosureId{2},
                                                 .from = KeyframeId{10},
                                                 .to = KeyframeId{90},
                                                 .T_from_to = Pose2(0.5, -0.25, 0.1),
                                                 .covariance = {.xx = 0.04, .yy = 0.09, .yaw_yaw = 0.0001},
                                                 .score = 0.75,
                                                 .dropped = true},
                                     .from_map = {1.0, 2.0},
                                     .to_map = {3.0, 4.0},
                                     .storey = StoreyId{3}});
  });
  const loop_closure_t closure = received<loop_closure_t>("T_LOOP_CLOSURE").at(0);
  EXPECT_EQ(closure.index, 2);
  EXPECT_EQ(closure.from_keyframe, 10);
  EXPECT_EQ(closure.to_keyframe, 90);
  EXPECT_EQ(closure.x, 0.5);
  EXPECT_DOUBLE_EQ(closure.sigma_x, 0.2);
  EXPECT_DOUBLE_EQ(closure.sigma_y, 0.3);
  EXPECT_DOUBLE_EQ(closure.sigma_yaw, 0.01);
  EXPECT_TRUE(closure.dropped);
  EXPECT_EQ(closure.to_map[1], 4.0);
  EXPECT_EQ(closure.storey, 3);
}

TEST_F(LcmPublisherTest, AnEventIsPublishedInWordsUnlessAStatusOrAPoseTellsIt) {
  publish([](Publisher& publisher) {
    publisher.publish_event(kNow, {VehicleEvent::Kind::kBatteryLow, 3150});
    publisher.publish_event(kNow, {VehicleEvent::Kind::kDataStopped, 0});
    publisher.publish_event(kNow, {VehicleEvent::Kind::kRangesFrozen, 0});
  });
  const auto events = received<vehicle_event_t>("T_VEHICLE_EVENT");
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, describe({VehicleEvent::Kind::kRangesFrozen, 0}));
}

TEST_F(LcmPublisherTest, TheStatusHoldsTheStateOfTheLink) {
  DaemonStatus status;
  status.input.live.link.condition = LinkCondition::kDeviceBusy;
  status.input.live.link.silences = 2;
  status.input.live.round_trip = std::chrono::microseconds(7500);
  status.input.live.vehicle.battery_mv = 3870;
  status.input.live.sharing = {.is_shared = true, .has_client = true, .counters = {}};
  status.input.live.sharing.counters.requests_dropped = 8;
  status.link_rates.ack_rate = 0.75;
  publish([&](Publisher& publisher) { publisher.publish_status(kNow, status); });
  const link_status_t link = received<status_t>("T_STATUS").at(0).link;
  EXPECT_EQ(link.condition, link_status_t::CONDITION_DEVICE_BUSY);
  EXPECT_EQ(link.silences, 2);
  EXPECT_DOUBLE_EQ(link.round_trip_ms, 7.5);
  EXPECT_DOUBLE_EQ(link.battery_v, 3.87);
  EXPECT_DOUBLE_EQ(link.ack_rate, 0.75);
  EXPECT_EQ(link.client, 1);
  EXPECT_EQ(link.client_requests_dropped, 8);
  EXPECT_EQ(link.flying, -1);
  EXPECT_EQ(link.rssi_dbm, 0);
}

TEST_F(LcmPublisherTest, TheStatusHoldsCountsQueuesAndTimes) {
  DaemonStatus status;
  status.state = DaemonState::kFinished;
  status.input.counters.gaps = 4;
  status.input.progress = 0.5;
  status.frontend.keyframes = 12;
  status.backend.closures_accepted = 3;
  status.tracking = {.tracking = Tracking::kUncertain,
                     .contradicting_share = 0.25,
                     .place_lead = 5.0,
                     .innovation = 1.5,
                     .way_since_agreement_m = 3.0,
                     .way_since_closure_m = 4.0,
                     .way_unplaced_m = 7.0};
  status.map = {.tiles = 5, .version_sum = 50};
  for (QueueStatistics& queue : status.queues) queue = {"samples", 256, 17, 1};
  status.stages = {{.name = "map", .count = 2, .p99_ms = 1.5, .p999_ms = 1.75}};
  status.missed_deadlines = 6;
  status.recording = {RecordingState::kFailed, 7};
  publish([&](Publisher& publisher) { publisher.publish_status(kNow, status); });
  const status_t message = received<status_t>("T_STATUS").at(0);
  EXPECT_EQ(message.state, status_t::STATE_FINISHED);
  EXPECT_EQ(message.gaps, 4);
  EXPECT_EQ(message.progress, 0.5);
  EXPECT_EQ(message.keyframes, 12);
  EXPECT_EQ(message.closures_accepted, 3);
  EXPECT_EQ(message.tracking.state, pose_t::TRACKING_UNCERTAIN);
  EXPECT_EQ(message.tracking.contradicting_share, 0.25);
  EXPECT_EQ(message.tracking.place_lead, 5.0);
  EXPECT_EQ(message.tracking.innovation, 1.5);
  EXPECT_EQ(message.tracking.way_since_agreement, 3.0);
  EXPECT_EQ(message.tracking.way_since_closure, 4.0);
  EXPECT_EQ(message.tracking.way_unplaced, 7.0);
  EXPECT_EQ(message.tile_count, 5);
  EXPECT_EQ(message.version_sum, 50);
  ASSERT_EQ(message.queue_count, 7);
  EXPECT_EQ(message.queues[0].name, "samples");
  EXPECT_EQ(message.queues[0].high_water, 17);
  ASSERT_EQ(message.stage_count, 1);
  EXPECT_EQ(message.stages[0].p99, 1.5);
  EXPECT_EQ(message.stages[0].p999, 1.75);
  EXPECT_EQ(message.missed_deadlines, 6);
  EXPECT_EQ(message.recording, status_t::RECORDING_FAILED);
  EXPECT_EQ(message.recorded_bytes, 7);
}

TEST_F(LcmPublisherTest, TheLargestMessagesFitOneDatagramEvenOnTheLongestChannel) {
  const std::string prefix(40, 'P');
  publish(
      [](Publisher& publisher) {
        publisher.publish_walls(kNow, std::vector<WallInMap>(kMaxWallsPerMessage));
        publisher.publish_tile(kNow, MapTile{}, 0.05);
        DaemonStatus status;
        for (QueueStatistics& queue : status.queues) queue.name = "a queue with a name of forty characters!";
        status.stages.assign(16, {.name = "a stage with a name of forty characters!"});
        publisher.publish_status(kNow, status);
      },
      prefix);
  // received() checks the size of every message in the log.
  EXPECT_EQ(received<landmarks_t>(prefix + "LANDMARKS").size(), 1U);
}

TEST_F(LcmPublisherTest, PublishesForMbotOnlyWhereItIsAskedTo) {
  const auto publish_pose = [](Publisher& publisher) { publisher.publish_pose({.stamp = kNow}); };
  publish(publish_pose);
  EXPECT_TRUE(received<pose2d_t>("SLAM_POSE").empty());
  publish(publish_pose, "T_", Compatibility::kMbot);
  EXPECT_EQ(received<pose2d_t>("SLAM_POSE").size(), 1U);
  EXPECT_EQ(received<pose_t>("T_POSE").size(), 1U);
}

template <typename Message>
std::uint64_t fingerprint() {
  return static_cast<std::uint64_t>(Message::getHash());
}

// A consumer built against other types would silently receive nothing: whoever changes a type must know it.
TEST(LcmTypes, HaveTheFingerprintsThatConsumersWereBuiltWith) {
  EXPECT_EQ(fingerprint<pose_t>(), 0x2b5a40ff739bec18U);
  EXPECT_EQ(fingerprint<pose2d_t>(), 0x1f317af1246276acU);
  EXPECT_EQ(fingerprint<ranges_t>(), 0x73529b4f4a288943U);
  EXPECT_EQ(fingerprint<map_info_t>(), 0xd4c16b4a90c4f334U);
  EXPECT_EQ(fingerprint<map_tile_t>(), 0x54c15ba6896b302cU);
  EXPECT_EQ(fingerprint<landmarks_t>(), 0x9cc0333c77a3af06U);
  EXPECT_EQ(fingerprint<loop_closure_t>(), 0x280a8e00175b414aU);
  EXPECT_EQ(fingerprint<vehicle_event_t>(), 0xa580549a7408b96eU);
  EXPECT_EQ(fingerprint<status_t>(), 0x29d24bc85eb44f1fU);
}

// A fingerprint is made of the fields' names and types alone. These are what lcm-gen makes of mbot_lcm_msgs.
TEST(LcmTypes, ForMbotHaveTheFingerprintsOfItsOwn) {
  EXPECT_EQ(fingerprint<pose2d_t>(), 0x1f317af1246276acU);               // pose2D_t
  EXPECT_EQ(fingerprint<mbot_lidar_t>(), 0x89dc5b879a5056cfU);           // lidar_t
  EXPECT_EQ(fingerprint<mbot_occupancy_grid_t>(), 0xd5447e494a66cc92U);  // occupancy_grid_t
}

}  // namespace
}  // namespace swiftlet
