// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// A consumer as others would write one: listens on LCM until the daemon reports its end, and writes
// the map that its tiles make. lcm_map_consumer URL MAP.pgm TIMEOUT_S

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/outputs/ros_map.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/status_t.hpp"

namespace swiftlet {
namespace {

class MapConsumer {
 public:
  explicit MapConsumer(lcm::LCM& lcm) {
    // By functions, not by methods: GCC 12's sanitizer takes LCM's calls of those for wild ones.
    lcm.subscribeFunction("SWIFTLET_MAP_TILE", take_tile, this);
    lcm.subscribeFunction("SWIFTLET_STATUS", take_status, this);
  }

  /// The daemon has finished and every tile is here at its newest.
  [[nodiscard]] bool is_complete() const {
    if (status_.state != status_t::STATE_FINISHED) return false;
    std::int64_t version_sum = 0;
    for (const auto& [index, tile] : tiles_) version_sum += tile.version;
    return static_cast<std::int32_t>(tiles_.size()) == status_.tile_count &&
           version_sum == status_.version_sum;
  }

  void write_map(std::ostream& file) const {
    std::vector<TileIndex> tiles;
    for (const auto& [index, tile] : tiles_) {
      if (holds_anything(tile)) tiles.push_back(index);
    }
    write_pgm(
        tiles, [this](TileIndex index) { return tiles_.at(index); },
        [&file](std::string_view bytes) { return static_cast<bool>(file << bytes); });
  }

  [[nodiscard]] std::string state() const {
    return std::to_string(tiles_.size()) + " of " + std::to_string(status_.tile_count) + " tiles, state " +
           std::to_string(static_cast<int>(status_.state));
  }

 private:
  status_t status_{};
  std::int64_t map_id_ = 0;
  std::map<TileIndex, MapTile> tiles_;

  /// False where a correction rubbed everything out again.
  static bool holds_anything(const MapTile& tile) {
    const auto& cells = tile.occupancy_percent;
    return std::any_of(cells.begin(), cells.end(), [](std::int8_t percent) { return percent >= 0; });
  }

  static void take_tile(const lcm::ReceiveBuffer*, const std::string&, const map_tile_t* message,
                        MapConsumer* self) {
    self->take(*message);
  }
  static void take_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* message,
                          MapConsumer* self) {
    self->status_ = *message;
  }

  void take(const map_tile_t& message) {
    if (message.map_id != map_id_) tiles_.clear();
    map_id_ = message.map_id;
    MapTile tile{.index = {message.tile_x, message.tile_y,
                           make_id<StoreyId>(static_cast<std::size_t>(message.storey))},
                 .version = static_cast<std::uint32_t>(message.version)};
    std::memcpy(tile.occupancy_percent.data(), message.occupancy_percent, sizeof(message.occupancy_percent));
    MapTile& kept = tiles_.try_emplace(tile.index, tile).first->second;
    if (tile.version >= kept.version) kept = tile;
  }
};

int consume(const std::string& url, const std::string& pgm_path, int timeout_s) {
  lcm::LCM lcm(url);
  if (!lcm.good()) return EXIT_FAILURE;
  MapConsumer consumer(lcm);
  std::puts("listening");
  std::fflush(stdout);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(timeout_s);
  while (!consumer.is_complete()) {
    if (lcm.handleTimeout(100) < 0) return EXIT_FAILURE;
    if (std::chrono::steady_clock::now() < end) continue;
    std::fprintf(stderr, "no complete map in time: %s\n", consumer.state().c_str());
    return EXIT_FAILURE;
  }
  std::ofstream file(pgm_path, std::ios::binary);
  consumer.write_map(file);
  std::printf("%s\n", consumer.state().c_str());
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: lcm_map_consumer URL MAP.pgm TIMEOUT_S\n");
    return 2;
  }
  return swiftlet::consume(argv[1], argv[2], std::atoi(argv[3]));
}
