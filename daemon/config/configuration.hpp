// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/base/result.hpp"
#include "core/base/settings.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/mapping/map_config.hpp"
#include "daemon/config/sensor_overrides.hpp"

namespace swiftlet {

/// How the daemon publishes.
struct PublishConfig {
  double status_period_s = 1.0;
  double tile_refresh_period_s = 10.0;
  std::string channel_prefix = "SWIFTLET_";

  static constexpr SettingsSection kSection{"publish", "What the daemon sends and how often."};
  static constexpr Setting<PublishConfig> kSettings[] = {
      {"status_period_s", &PublishConfig::status_period_s, "s",
       "between two status messages; walls and the map's summary go with them", 0.05, 3600},
      {"tile_refresh_period_s", &PublishConfig::tile_refresh_period_s, "s",
       "every tile is sent again at least this often, for late joiners", 0.1, 3600},
      {"channel_prefix", &PublishConfig::channel_prefix, "", "what every channel's name begins with"},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What the daemon records.
struct RecordConfig {
  bool enabled = true;
  std::string directory;
  int max_file_mb = 64;
  int max_total_mb = 2000;

  static constexpr SettingsSection kSection{"record", "What the daemon records: [recording](recording.md)."};
  static constexpr Setting<RecordConfig> kSettings[] = {
      {"enabled", &RecordConfig::enabled, "",
       "radio, cable and UDP are recorded unless --no-record is given"},
      {"directory", &RecordConfig::directory, "", "where recordings go; empty: the state directory"},
      {"max_file_mb", &RecordConfig::max_file_mb, "MB",
       "a recording that has grown this long is continued in a new file; at most max_total_mb", 1, 4000},
      {"max_total_mb", &RecordConfig::max_total_mb, "MB",
       "the oldest recordings in the directory are removed so that no more than this is used", 1, 1000000},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Whether another program flies over the daemon's link.
struct ShareConfig {
  std::string address;

  static constexpr SettingsSection kSection{
      "share", "Who else may use the vehicle while it is mapped: [flying](flying.md#who-flies)."};
  static constexpr Setting<ShareConfig> kSettings[] = {
      {"address", &ShareConfig::address, "",
       "where one client may connect to a live vehicle, as udp://ADDRESS:PORT; empty: nowhere, unless "
       "--share is given"},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const { return setting_problems(*this); }
};

/// Whether the daemon shows its run in browsers.
struct ViewConfig {
  std::string address;

  static constexpr SettingsSection kSection{"view", "The page of the run: [live map](view.md)."};
  static constexpr Setting<ViewConfig> kSettings[] = {
      {"address", &ViewConfig::address, "",
       "where swiftletd serves the page, as 127.0.0.1:8440; empty: nowhere, unless --view is given"},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const { return setting_problems(*this); }
};

/// What the daemon asks of the machine so that it keeps time; everything is off unless asked for.
struct RealtimeConfig {
  double pose_deadline_s = 0.002;
  int radio_priority = 0;
  int frontend_priority = 0;
  int publisher_priority = 0;
  int radio_cpu = -1;
  int frontend_cpu = -1;
  int backend_cpu = -1;
  int publisher_cpu = -1;
  bool lock_memory = false;

  static constexpr SettingsSection kSection{
      "realtime", "What the daemon asks of the machine: [real time](real_time.md)."};
  static constexpr Setting<RealtimeConfig> kSettings[] = {
      {"pose_deadline_s", &RealtimeConfig::pose_deadline_s, "s",
       "from the radio frame to the published pose; what takes longer is counted", 0.00001, 10},
      {"radio_priority", &RealtimeConfig::radio_priority, "",
       "SCHED_FIFO priority of the thread; 0: like any other program", 0, 99},
      {"frontend_priority", &RealtimeConfig::frontend_priority, "", "the same", 0, 99},
      {"publisher_priority", &RealtimeConfig::publisher_priority, "", "the same", 0, 99},
      {"radio_cpu", &RealtimeConfig::radio_cpu, "", "the only processor the thread runs on; -1: any", -1,
       1023},
      {"frontend_cpu", &RealtimeConfig::frontend_cpu, "", "the same", -1, 1023},
      {"backend_cpu", &RealtimeConfig::backend_cpu, "", "the same", -1, 1023},
      {"publisher_cpu", &RealtimeConfig::publisher_cpu, "", "the same", -1, 1023},
      {"lock_memory", &RealtimeConfig::lock_memory, "",
       "nothing is ever swapped out or read in again; stacks are touched first"},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const { return setting_problems(*this); }
};

struct Configuration {
  SensorOverrides sensor;
  FrontendConfig frontend;
  BackendConfig backend;
  MapConfig map;
  PublishConfig publish;
  RecordConfig record;
  ShareConfig share;
  ViewConfig view;
  RealtimeConfig realtime;

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Calls visit(section) for each section, in the order of the reference page. `config` is a Configuration,
/// const or not.
template <typename AnyConfiguration, typename Visitor>
void for_each_section(AnyConfiguration&& config, Visitor visit) {
  visit(config.sensor);
  visit(config.frontend);
  visit(config.backend);
  visit(config.map);
  visit(config.publish);
  visit(config.record);
  visit(config.share);
  visit(config.view);
  visit(config.realtime);
}

/// Calls visit(part, tuning) for each Tuning struct of `config`.
template <typename AnyConfiguration, typename Visitor>
void for_each_tuning(AnyConfiguration&& config, Visitor visit) {
  auto& frontend = config.frontend.tuning;
  visit("frontend_multiscan", frontend.multiscan);
  visit("frontend_lines", frontend.lines);
  visit("frontend_solver", frontend.solver);
  visit("frontend_drift", frontend.drift);
  visit("frontend_axis", frontend.axis);
  visit("frontend_walls", frontend.axis.walls);
  auto& backend = config.backend.tuning;
  visit("backend_submap", backend.submap);
  visit("backend_detector", backend.detector);
  visit("backend_matcher", backend.matcher);
  visit("backend_cross_check", backend.cross_check);
  visit("backend_places", backend.places);
  visit("backend_covariance", backend.covariance);
  visit("backend_confidence", backend.confidence);
  visit("backend_axis", backend.axis);
  visit("backend_walls", backend.walls);
  visit("backend_graph", backend.graph);
  visit("backend_refinement", backend.refinement);
  visit("backend_joint", backend.joint);
  visit("backend_floor", backend.floor);
  visit("backend_wall_fit", backend.refinement.walls);
  visit("backend_poses_and_walls", backend.poses_and_walls);
  visit("backend_nodes", backend.nodes);
  visit("backend_patches", backend.patches);
  visit("backend_online", backend.online);
  visit("backend_index", backend.index);
  visit("backend_pruning", backend.pruning);
  visit("map_drawing", config.map.tuning.drawing);
  visit("map_walls", config.map.tuning.walls);
}

/// Reads a TOML file. Unknown and duplicate keys, wrong types and impossible values are refused with file and
/// line; kNotFound when there is no such file. Without a path: the defaults. `settings`, TOML as well, stands
/// above the file; what is wrong there is named without a line.
[[nodiscard]] Result<Configuration> load_configuration(const std::string& path,
                                                       const std::string& settings = {});

/// docs/configuration.md, whole.
[[nodiscard]] std::string configuration_reference();

/// All tuning of `config` as a configuration file has it, each with its range: for experiments.
[[nodiscard]] std::string tuning_text(const Configuration& config);

}  // namespace swiftlet
