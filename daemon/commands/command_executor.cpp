// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_executor.hpp"

#include <spdlog/spdlog.h>

namespace swiftlet {

void CommandExecutor::execute(const Command& command, const MapBuilder& map, std::optional<HostTime> newest) {
  switch (command.kind) {
    case Command::Kind::kSaveMap:
      return save_map(map);
    case Command::Kind::kMarkPlace:
      return mark_place(command, newest);
    case Command::Kind::kNewMap:
      return begin_new_map();
  }
}

void CommandExecutor::save_map(const MapBuilder& map) const {
  if (!run_.directory) return spdlog::warn("the map is not saved: this run writes no outputs (--no-output)");
  const Status written = write_map_files(*run_.directory, map);
  if (!written) return spdlog::error("the map is not saved: {}", written.error().message);
  spdlog::info("map saved: {}", (*run_.directory / "map.pgm").string());
}

void CommandExecutor::mark_place(const Command& command, std::optional<HostTime> newest) {
  if (!run_.directory)
    return spdlog::warn("the place {} is not marked: this run writes no outputs (--no-output)",
                        command.name_text());
  if (!newest) return spdlog::warn("the place {} is not marked: there is no pose yet", command.name_text());
  places_.push_back({.stamp = *newest, .name = std::string(command.name_text())});
  spdlog::info("place {} marked", command.name_text());
}

void CommandExecutor::begin_new_map() {
  if (!run_.is_live) return spdlog::warn("no new map is begun: only of a live vehicle is there more to come");
  if (run_.has_client())
    return spdlog::warn(
        "no new map is begun: it would cut off the program that uses the vehicle over this link; "
        "disconnect that first");
  wants_new_map_ = true;
  spdlog::info("a new map: this run ends");
  run_.end();
}

}  // namespace swiftlet
