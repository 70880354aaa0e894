// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/base/result.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/mapping/map_config.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// What a configuration file may say about the sensor; what it leaves out comes from the input's own kind.
struct SensorOverrides {
  std::optional<double> min_range_m;
  std::optional<double> max_range_m;
  std::optional<double> range_sigma_m;
  std::optional<double> range_age_s;
  std::optional<double> odometry_xy_per_metre;
  std::optional<double> odometry_yaw_per_radian;
  std::optional<double> odometry_yaw_per_metre_rad;
  std::optional<double> drift_yaw_per_metre_rad;
  std::optional<double> drift_yaw_per_radian;
  std::optional<double> odometry_forward_scale;
  std::optional<double> odometry_sideways_scale;
  std::optional<double> missed_yaw_per_metre_rad;
  std::optional<double> missed_yaw_per_radian;
  std::optional<double> missed_yaw_per_second_rad;

  /// The input's model with what is set here put in its place.
  [[nodiscard]] SensorModel applied_to(SensorModel model) const;
};

/// How the daemon publishes.
struct PublishConfig {
  double status_period_s = 1.0;         ///< between two status messages
  double tile_refresh_period_s = 10.0;  ///< every tile is sent again at least this often, for late joiners
  std::string channel_prefix = "SWIFTLET_";
};

/// What the daemon keeps of what it hears.
struct RecordConfig {
  bool enabled = true;      ///< live links are recorded
  std::string directory;    ///< empty: the state directory
  int max_file_mb = 64;     ///< beyond this a recording is continued in a new file
  int max_total_mb = 2000;  ///< beyond this the oldest recordings in the directory are removed
};

/// What the daemon asks of the machine so that it keeps time; everything is off unless asked for.
struct RealtimeConfig {
  double pose_deadline_s = 0.002;  ///< from radio frame to published pose; what takes longer is counted
  int radio_priority = 0;          ///< SCHED_FIFO, 1 to 99; 0: like any other program
  int frontend_priority = 0;
  int publisher_priority = 0;
  int radio_cpu = -1;  ///< the only processor the thread runs on; -1: any
  int frontend_cpu = -1;
  int backend_cpu = -1;
  int publisher_cpu = -1;
  bool lock_memory = false;  ///< nothing is ever swapped out or read in again
};

struct Configuration {
  SensorOverrides sensor;
  FrontendConfig frontend;
  BackendConfig backend;
  MapConfig map;
  PublishConfig publish;
  RecordConfig record;
  RealtimeConfig realtime;

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Reads a TOML file. Unknown and duplicate keys, wrong types and impossible values are refused with file and
/// line; kNotFound when there is no such file.
[[nodiscard]] Result<Configuration> load_configuration(const std::string& path);

}  // namespace swiftlet
