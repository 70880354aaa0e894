// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/outputs/run_outputs.hpp"
#include "daemon/workers/command.hpp"

namespace swiftlet {

/// Executes the commands of one run, and logs what became of each. execute() is for the backend's thread;
/// what it did may be asked for once the run is over.
class CommandExecutor {
 public:
  struct Run {
    std::optional<std::filesystem::path> directory;  ///< of its outputs, if it has any
    bool is_live = false;                            ///< its vehicle is there for another run
    std::function<bool()> has_client;                ///< another program uses the vehicle over its link
    std::function<void()> end;                       ///< ends it, to begin the next one
  };
  explicit CommandExecutor(Run run) : run_(std::move(run)) {}

  void execute(const Command& command, const MapBuilder& map, std::optional<HostTime> newest);

  [[nodiscard]] const std::vector<MarkedPlace>& places() const { return places_; }
  [[nodiscard]] bool wants_new_map() const { return wants_new_map_; }

 private:
  void save_map(const MapBuilder& map) const;
  void mark_place(const Command& command, std::optional<HostTime> newest);
  void begin_new_map();

  Run run_;
  std::vector<MarkedPlace> places_;
  bool wants_new_map_ = false;
};

}  // namespace swiftlet
