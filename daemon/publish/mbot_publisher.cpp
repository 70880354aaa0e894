// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/mbot_publisher.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/geometry/angle.hpp"
#include "daemon/publish/message_parts.hpp"
#include "swiftlet/mbot_lidar_t.hpp"
#include "swiftlet/mbot_occupancy_grid_t.hpp"

namespace swiftlet {
namespace {

using Cells = std::array<std::int8_t, kCellsInTile>;

constexpr int kSurest = 127;

/// Of two cells that become one: a wall stays a wall.
std::int8_t joined(std::int8_t a, std::int8_t b) { return a > 0 || b > 0 ? std::max(a, b) : std::min(a, b); }

/// The cells around the tiles that hold anything.
struct GridLayout {
  int first_x = 0;  ///< cell of the map with the lowest x and y
  int first_y = 0;
  int width = 0;  ///< cells of the map
  int height = 0;
  int coarseness = 1;  ///< cells of the map along the side of one of the message

  [[nodiscard]] int columns() const { return (width + coarseness - 1) / coarseness; }
  [[nodiscard]] int rows() const { return (height + coarseness - 1) / coarseness; }
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  }
};

GridLayout layout_of(const MapSummary& map) {
  GridLayout layout{.first_x = map.lowest.x * kTileCells,
                    .first_y = map.lowest.y * kTileCells,
                    .width = (map.highest.x - map.lowest.x + 1) * kTileCells,
                    .height = (map.highest.y - map.lowest.y + 1) * kTileCells};
  while (layout.cells() > kMaxMbotCells) layout.coarseness *= 2;
  return layout;
}

class MbotPublisher final : public Publisher {
 public:
  MbotPublisher(std::unique_ptr<Publisher> own, MessageSink sink)
      : own_(std::move(own)), sink_(std::move(sink)) {}

  void publish_pose(const PoseUpdate& pose) override {
    own_->publish_pose(pose);
    storey_ = pose.storey;
    send("SLAM_POSE", pose2d_message(pose.stamp, pose.T_map_body));
    send("MBOT_ODOMETRY", pose2d_message(pose.stamp, pose.T_odom_body));
    send_lidar(pose);
  }
  void publish_tile(HostTime now, const MapTile& tile, double resolution_m) override {
    own_->publish_tile(now, tile, resolution_m);
    std::transform(tile.occupancy_percent.begin(), tile.occupancy_percent.end(), tiles_[tile.index].begin(),
                   mbot_log_odds);
  }
  void publish_map(HostTime now, const MapSummary& map) override {
    own_->publish_map(now, map);
    send_grid(now, map);
  }
  void publish_walls(HostTime now, std::span<const WallInMap> walls) override {
    own_->publish_walls(now, walls);
  }
  void publish_closure(HostTime now, const ClosureUpdate& update) override {
    own_->publish_closure(now, update);
  }
  void publish_event(HostTime now, const VehicleEvent& event) override { own_->publish_event(now, event); }
  void publish_status(HostTime now, const DaemonStatus& status) override {
    own_->publish_status(now, status);
  }

 private:
  std::unique_ptr<Publisher> own_;
  MessageSink sink_;
  std::map<TileIndex, Cells> tiles_;
  StoreyId storey_{};  // where the vehicle is: a grid shows one
  // Kept from message to message for their storage.
  mbot_lidar_t lidar_;
  mbot_occupancy_grid_t grid_;
  std::vector<std::uint8_t> buffer_;

  /// What LCM does not take is lost: `own_` reports it of its own messages.
  template <typename Message>
  void send(const std::string& channel, const Message& message) {
    buffer_.resize(static_cast<std::size_t>(message.getEncodedSize()));
    const int bytes = message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
    SWIFTLET_CHECK(bytes == static_cast<int>(buffer_.size()), "a message has the size that it says");
    static_cast<void>(sink_(channel, buffer_));
  }

  void send_lidar(const PoseUpdate& pose) {
    const BeamReadings& beams = pose.beams;
    lidar_.utime = to_utime(pose.stamp);
    lidar_.num_ranges = beams.count;
    lidar_.ranges.resize(beams.count);
    lidar_.thetas.resize(beams.count);
    lidar_.times.assign(beams.count, lidar_.utime);
    lidar_.intensities.assign(beams.count, 0.0F);
    for (std::size_t i = 0; i < beams.count; ++i) {
      lidar_.ranges[i] = beams.status[i] == RangeStatus::kHit ? beams.distance_m[i] : 0.0F;
      const float bearing_rad = beams.bearing_rad[i];
      lidar_.thetas[i] = bearing_rad < 0.0F ? bearing_rad + static_cast<float>(2.0 * kPi) : bearing_rad;
    }
    send("LIDAR", lidar_);
  }

  void send_grid(HostTime now, const MapSummary& map) {
    const GridLayout layout = layout_of(map);
    grid_.utime = to_utime(now);
    grid_.origin_x = static_cast<float>(layout.first_x * map.resolution_m);
    grid_.origin_y = static_cast<float>(layout.first_y * map.resolution_m);
    grid_.meters_per_cell = static_cast<float>(map.resolution_m * layout.coarseness);
    grid_.width = layout.columns();
    grid_.height = layout.rows();
    grid_.num_cells = static_cast<std::int32_t>(layout.cells());
    grid_.cells.assign(layout.cells(), 0);
    for (const auto& [index, cells] : tiles_)
      if (index.storey == storey_) draw(index, cells, layout);
    send("SLAM_MAP", grid_);
  }

  void draw(TileIndex index, const Cells& cells, const GridLayout& layout) {
    for (int i = 0; i < kTileCells * kTileCells; ++i) {
      const std::int8_t cell = cells[static_cast<std::size_t>(i)];
      if (cell == 0) continue;  // also all cells of a tile outside: nothing is left in it
      const int column = (index.x * kTileCells + i % kTileCells - layout.first_x) / layout.coarseness;
      const int row = (index.y * kTileCells + i / kTileCells - layout.first_y) / layout.coarseness;
      const auto cells_before = static_cast<std::size_t>(row) * static_cast<std::size_t>(layout.columns());
      std::int8_t& drawn = grid_.cells[cells_before + static_cast<std::size_t>(column)];
      drawn = joined(drawn, cell);
    }
  }
};

}  // namespace

std::int8_t mbot_log_odds(std::int8_t occupancy_percent) {
  const int percent = occupancy_percent;
  if (percent >= kOccupiedFromPercent)
    return static_cast<std::int8_t>(1 + (percent - kOccupiedFromPercent) * (kSurest - 1) /
                                            (100 - kOccupiedFromPercent));
  if (percent < 0 || percent >= kFreeBelowPercent) return 0;
  return static_cast<std::int8_t>(-1 - (kFreeBelowPercent - 1 - percent) * (kSurest - 1) /
                                           (kFreeBelowPercent - 1));
}

std::unique_ptr<Publisher> make_mbot_publisher(std::unique_ptr<Publisher> own, MessageSink sink) {
  return std::make_unique<MbotPublisher>(std::move(own), std::move(sink));
}

}  // namespace swiftlet
