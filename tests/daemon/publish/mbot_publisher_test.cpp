// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/mbot_publisher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "daemon/outputs/ros_map.hpp"
#include "swiftlet/mbot_lidar_t.hpp"
#include "swiftlet/mbot_occupancy_grid_t.hpp"
#include "swiftlet/pose2d_t.hpp"

namespace swiftlet {
namespace {

const HostTime kMbotTime{std::chrono::seconds(1'700'000'001)};
constexpr std::int64_t kMbotUtime = 1'700'000'001'000'000;

/// The newest message of each channel.
class MbotPublisherTest : public testing::Test {
 protected:
  template <typename Message>
  Message received(const std::string& channel) {
    Message message;
    const auto& bytes = messages_[channel];
    EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()))
        << channel;
    return message;
  }
  /// A tile of cells that are all of this percentage.
  void publish_tile(TileIndex index, std::int8_t percent) {
    MapTile tile{.index = index, .version = 1};
    tile.occupancy_percent.fill(percent);
    publisher_->publish_tile(kMbotTime, tile, 0.05);
  }

  std::map<std::string, std::vector<std::uint8_t>> messages_;
  std::unique_ptr<Publisher> publisher_ =
      make_mbot_publisher(std::make_unique<Publisher>(),
                          [this](const std::string& channel, std::span<const std::uint8_t> message) {
                            messages_[channel] = {message.begin(), message.end()};
                            return true;
                          });
};

TEST_F(MbotPublisherTest, SaysWhereTheVehicleIs) {
  publisher_->publish_pose(
      {.stamp = kMbotTime, .T_map_body = Pose2(1.0, 2.0, 0.5), .T_odom_body = Pose2(-1.0, -2.0, -0.5)});
  const auto pose = received<pose2d_t>("SLAM_POSE");
  EXPECT_EQ(pose.utime, kMbotUtime);
  EXPECT_EQ(pose.x, 1.0F);
  EXPECT_EQ(pose.y, 2.0F);
  EXPECT_EQ(pose.theta, 0.5F);
  EXPECT_EQ(received<pose2d_t>("MBOT_ODOMETRY").x, -1.0F);
}

TEST_F(MbotPublisherTest, ABeamWithoutAReturnHasNoRange) {
  BeamReadings beams = BeamReadings::of({3, {0.0, 0.5, -0.5}}, SensorModel::crazyflie());
  beams.distance_m = {1.5F, 3.0F, 1.0F};
  beams.status = {RangeStatus::kHit, RangeStatus::kNoReturn, RangeStatus::kInvalid};
  publisher_->publish_pose({.stamp = kMbotTime, .beams = beams});
  const auto lidar = received<mbot_lidar_t>("LIDAR");
  EXPECT_EQ(lidar.utime, kMbotUtime);
  EXPECT_EQ(lidar.num_ranges, 3);
  EXPECT_THAT(lidar.ranges, testing::ElementsAre(1.5F, 0.0F, 0.0F));
  EXPECT_THAT(lidar.thetas, testing::ElementsAre(0.0F, 0.5F, testing::FloatNear(5.783F, 0.001F)));
  EXPECT_THAT(lidar.times, testing::Each(kMbotUtime));
  EXPECT_EQ(lidar.intensities.size(), 3U);
}

TEST_F(MbotPublisherTest, TheGridHoldsTheTilesInTheirPlaces) {
  publish_tile({-1, 2}, 98);
  MapTile tile{.index = {0, 3}, .version = 1};
  tile.occupancy_percent.fill(-1);
  tile.occupancy_percent[2 * kTileCells + 5] = 2;
  publisher_->publish_tile(kMbotTime, tile, 0.05);
  publisher_->publish_map(kMbotTime,
                          {.resolution_m = 0.05, .tiles = 2, .lowest = {-1, 2}, .highest = {0, 3}});
  const auto grid = received<mbot_occupancy_grid_t>("SLAM_MAP");
  EXPECT_EQ(grid.utime, kMbotUtime);
  EXPECT_FLOAT_EQ(grid.origin_x, -3.2F);
  EXPECT_FLOAT_EQ(grid.origin_y, 6.4F);
  EXPECT_FLOAT_EQ(grid.meters_per_cell, 0.05F);
  EXPECT_EQ(grid.width, 128);
  EXPECT_EQ(grid.height, 128);
  ASSERT_EQ(grid.num_cells, 128 * 128);
  EXPECT_GT(grid.cells[0], 100);
  EXPECT_EQ(grid.cells[64], 0);
  EXPECT_LT(grid.cells[(64 + 2) * 128 + 64 + 5], -100);
  EXPECT_EQ(grid.cells[(64 + 2) * 128 + 64 + 6], 0);
}

TEST_F(MbotPublisherTest, TheGridIsOfTheStoreyWhereTheVehicleIs) {
  publish_tile({0, 0}, 98);
  publish_tile({0, 0, StoreyId{1}}, 2);
  const MapSummary map{.resolution_m = 0.05, .tiles = 2, .lowest = {0, 0}, .highest = {0, 0}};
  publisher_->publish_map(kMbotTime, map);
  EXPECT_GT(received<mbot_occupancy_grid_t>("SLAM_MAP").cells[0], 100);
  publisher_->publish_pose({.stamp = kMbotTime, .storey = StoreyId{1}});
  publisher_->publish_map(kMbotTime, map);
  EXPECT_LT(received<mbot_occupancy_grid_t>("SLAM_MAP").cells[0], -100);
}

TEST_F(MbotPublisherTest, WhatWasErasedIsUnknownAgain) {
  publish_tile({0, 0}, 98);
  publish_tile({1, 0}, 98);
  publish_tile({1, 0}, -1);
  publisher_->publish_map(kMbotTime, {.resolution_m = 0.05, .tiles = 2});
  EXPECT_EQ(received<mbot_occupancy_grid_t>("SLAM_MAP").num_cells, 64 * 64);
}

TEST_F(MbotPublisherTest, AMapTooLargeForOneMessageIsMadeCoarser) {
  publish_tile({0, 0}, 2);
  MapTile wall{.index = {9, 0}, .version = 1};
  wall.occupancy_percent.fill(2);
  wall.occupancy_percent[0] = 98;
  publisher_->publish_tile(kMbotTime, wall, 0.05);
  publisher_->publish_map(kMbotTime, {.resolution_m = 0.05, .tiles = 2, .lowest = {0, 0}, .highest = {9, 9}});
  const auto grid = received<mbot_occupancy_grid_t>("SLAM_MAP");
  EXPECT_EQ(grid.width, 320);
  EXPECT_LE(static_cast<std::size_t>(grid.num_cells), kMaxMbotCells);
  EXPECT_FLOAT_EQ(grid.meters_per_cell, 0.1F);
  EXPECT_LT(grid.cells[0], 0);
  EXPECT_GT(grid.cells[288], 0) << "a wall stays a wall";
  EXPECT_LT(grid.cells[289], 0);
}

TEST(MbotLogOdds, HaveTheSignsOfMapPgm) {
  for (int percent = -1; percent <= 100; ++percent) {
    const std::uint8_t value = pgm_value(static_cast<std::int8_t>(percent));
    const int odds = mbot_log_odds(static_cast<std::int8_t>(percent));
    EXPECT_EQ(odds > 0, value == kPgmOccupied) << percent;
    EXPECT_EQ(odds < 0, value == kPgmFree) << percent;
  }
  EXPECT_EQ(mbot_log_odds(100), 127);
  EXPECT_EQ(mbot_log_odds(0), -127);
}

}  // namespace
}  // namespace swiftlet
