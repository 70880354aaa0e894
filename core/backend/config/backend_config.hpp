// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/base/settings.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {

/// Settings of submaps, loop closing and the pose graph (Algorithm 3). One set serves all places and sensors.
struct BackendConfig {
  // Submaps
  double submap_length_m = 6.0;
  double grid_resolution_m = 0.1;
  double hit_probability = 0.62;
  double miss_probability = 0.45;
  int max_kernel_cells = 3;

  // Loop closing
  bool close_loops = true;
  double multiscan_length_m = 6.0;
  int match_every_keyframes = 2;
  double min_travel_between_m = 12.0;
  double search_radius_m = 8.0;
  double search_angle_rad = radians(30);
  int max_candidates = 8;
  double min_score = 0.45;
  int min_match_points = 30;

  // Pose graph
  bool align_to_walls = true;
  double dcs_phi = 5.0;
  double drop_scale = 0.1;
  int optimizer_iterations = 20;

  // Joint refinement
  bool refine = true;
  bool refine_online = true;
  int refinement_iterations = 8;
  bool floor_varies = true;
  bool map_again = true;

  // Known space
  int max_scans = 20000;

  static constexpr SettingsSection kSection{"backend", "Submaps, loop closing and the pose graph."};
  static constexpr Setting<BackendConfig> kSettings[] = {
      {"submap_length_m", &BackendConfig::submap_length_m, "m", "a submap covers this much travel", 0.5,
       1000},
      {"grid_resolution_m", &BackendConfig::grid_resolution_m, "m", "cell size of submaps", 0.01, 1},
      {"hit_probability", &BackendConfig::hit_probability, "", "p(occupied given that a beam ended here)",
       0.501, 0.999},
      {"miss_probability", &BackendConfig::miss_probability, "",
       "p(occupied given that a beam passed through)", 0.001, 0.499},
      {"max_kernel_cells", &BackendConfig::max_kernel_cells, "",
       "width of the max kernel (eq. 22), odd; 1 is eq. 21, no kernel", 1, 15},
      {"close_loops", &BackendConfig::close_loops, "", "false: the frontend alone, a baseline"},
      {"multiscan_length_m", &BackendConfig::multiscan_length_m, "m",
       "the recent travel that is matched against submaps", 0.5, 1000},
      {"match_every_keyframes", &BackendConfig::match_every_keyframes, "",
       "look for loops at every n-th keyframe", 1, 1000},
      {"min_travel_between_m", &BackendConfig::min_travel_between_m, "m",
       "travel between the two ends of a closure", 0, 10000},
      {"search_radius_m", &BackendConfig::search_radius_m, "m", "widest search around the predicted position",
       0.1, 50},
      {"search_angle_rad", &BackendConfig::search_angle_rad, "rad",
       "widest search around the predicted heading", LoopDetectorTuning().min_search_angle_rad, kPi},
      {"max_candidates", &BackendConfig::max_candidates, "",
       "submaps searched per keyframe at most, the most overlapping first", 1, 1000},
      {"min_score", &BackendConfig::min_score, "",
       "mean probability under the scan's points that makes a closure in the narrowest window; "
       "wider ones ask for more",
       0.01, 0.99},
      {"min_match_points", &BackendConfig::min_match_points, "", "fewer points decide nothing", 3, 100000},
      {"align_to_walls", &BackendConfig::align_to_walls, "",
       "hold the heading by the axis that a building's walls share"},
      {"dcs_phi", &BackendConfig::dcs_phi, "", "closures whose chi-square exceeds this are scaled down (DCS)",
       0.001, 1000000},
      {"drop_scale", &BackendConfig::drop_scale, "",
       "closures scaled below this at the end of a run are dropped", 0, 0.99},
      {"optimizer_iterations", &BackendConfig::optimizer_iterations, "",
       "Gauss-Newton steps of one solution at most; while flying 4 a keyframe, but for trials", 1, 1000},
      {"refine", &BackendConfig::refine, "",
       "false: poses between keyframes stay interpolated, while flying and at the end"},
      {"refine_online", &BackendConfig::refine_online, "", "false: poses are refined at the end only"},
      {"refinement_iterations", &BackendConfig::refinement_iterations, "",
       "rounds of walls and poses in turn, at the end of a run", 1, 1000},
      {"floor_varies", &BackendConfig::floor_varies, "",
       "at the end of a flight find floors of which the flow sensor sees a part"},
      {"map_again", &BackendConfig::map_again, "",
       "at the end of a run map it again, with other noise of the heading and backwards, and keep the best "
       "map"},
      {"max_scans", &BackendConfig::max_scans, "",
       "with more than these that have returns, scans of space that others cover as well are pruned; "
       "600 are a minute at 10 Hz",
       1000, 100000000},
  };

  BackendTuning tuning;  ///< no setting: for experiments

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace swiftlet
