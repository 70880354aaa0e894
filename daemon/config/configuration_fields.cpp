// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/configuration_fields.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <type_traits>

#include "core/geometry/angle.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/multiscan.hpp"

namespace swiftlet {
namespace {

/// The section of `config` that holds a member of `Section`.
template <typename Section>
Section& section_in(Configuration& config) {
  if constexpr (std::is_same_v<Section, SensorOverrides>) return config.sensor;
  if constexpr (std::is_same_v<Section, FrontendConfig>) return config.frontend;
  if constexpr (std::is_same_v<Section, BackendConfig>) return config.backend;
  if constexpr (std::is_same_v<Section, MapConfig>) return config.map;
  if constexpr (std::is_same_v<Section, PublishConfig>) return config.publish;
  if constexpr (std::is_same_v<Section, RecordConfig>) return config.record;
  if constexpr (std::is_same_v<Section, RealtimeConfig>) return config.realtime;
}

template <typename Section, typename T>
FieldPointer place_of(T Section::*field, Configuration& config) {
  return &(section_in<Section>(config).*field);
}
template <auto kField>
FieldPointer at(Configuration& config) {
  return place_of(kField, config);
}

constexpr ConfigurationField kFields[] = {
    {"sensor", "min_range_m", "m", "shorter readings are invalid; less than max_range_m", 0, 10,
     at<&SensorOverrides::min_range_m>},
    {"sensor", "max_range_m", "m", "longer readings count as no return", 0.1, 100,
     at<&SensorOverrides::max_range_m>},
    {"sensor", "range_sigma_m", "m", "standard deviation of a reading, along the beam", 0.0001, 1,
     at<&SensorOverrides::range_sigma_m>},
    {"sensor", "range_age_s", "s", "how much older the ranges of a packet are than its stamp", 0, 1,
     at<&SensorOverrides::range_age_s>},
    {"sensor", "odometry_xy_per_metre", "m/m", "standard deviation of a step's position, per metre travelled",
     0, 1, at<&SensorOverrides::odometry_xy_per_metre>},
    {"sensor", "odometry_yaw_per_radian", "rad/rad",
     "standard deviation of a step's heading, per radian turned", 0, 1,
     at<&SensorOverrides::odometry_yaw_per_radian>},
    {"sensor", "odometry_yaw_per_metre_rad", "rad/m",
     "standard deviation of a step's heading, per metre travelled", 0, 1,
     at<&SensorOverrides::odometry_yaw_per_metre_rad>},
    {"sensor", "drift_yaw_per_metre_rad", "rad/m",
     "standard deviation of the yaw that dead reckoning misses with every metre; 0: none is learnt", 0, 1,
     at<&SensorOverrides::drift_yaw_per_metre_rad>},
    {"sensor", "drift_yaw_per_radian", "rad/rad", "the same with every radian turned", 0, 1,
     at<&SensorOverrides::drift_yaw_per_radian>},
    {"sensor", "odometry_forward_scale", "m/m",
     "metres moved per metre of dead reckoning, forward; this and what follows tells swiftlet calibrate", 0.5,
     2, at<&SensorOverrides::odometry_forward_scale>},
    {"sensor", "odometry_sideways_scale", "m/m", "the same sideways", 0.5, 2,
     at<&SensorOverrides::odometry_sideways_scale>},
    {"sensor", "missed_yaw_per_metre_rad", "rad/m", "yaw that dead reckoning misses with every metre forward",
     -0.5, 0.5, at<&SensorOverrides::missed_yaw_per_metre_rad>},
    {"sensor", "missed_yaw_per_radian", "rad/rad", "the same with every radian turned", -0.5, 0.5,
     at<&SensorOverrides::missed_yaw_per_radian>},
    {"sensor", "missed_yaw_per_second_rad", "rad/s", "the same with every second in motion", -0.1, 0.1,
     at<&SensorOverrides::missed_yaw_per_second_rad>},
    {"frontend", "use_landmarks", "", "false: dead reckoning only, a baseline", 0, 0,
     at<&FrontendConfig::use_landmarks>},
    {"frontend", "keyframe_distance_m", "m", "a keyframe after this much travel", 0.01, 10,
     at<&FrontendConfig::keyframe_distance_m>},
    {"frontend", "keyframe_turn_rad", "rad", "a keyframe after this much turning", 0.01, 3.2,
     at<&FrontendConfig::keyframe_turn_rad>},
    {"frontend", "multiscan_points", "",
     "k scans are seen together, k = this / beams, rounded up, at least 2", 8,
     double{kMaxMultiscanPoints - kMaxBeams}, at<&FrontendConfig::multiscan_points>},
    {"frontend", "split_distance_m", "m", "a point farther than this from the chord splits a segment", 0.001,
     2, at<&FrontendConfig::split_distance_m>},
    {"frontend", "max_point_gap_m", "m", "neighbours along a line farther apart than this are not one wall",
     0.01, 10, at<&FrontendConfig::max_point_gap_m>},
    {"frontend", "min_line_points", "", "fewer points make no line", 3,
     double{kMaxMultiscanPoints - kMaxBeams}, at<&FrontendConfig::min_line_points>},
    {"frontend", "min_line_length_m", "m", "shorter segments are not used", 0.01, 10,
     at<&FrontendConfig::min_line_length_m>},
    {"frontend", "max_line_rms_m", "m", "points scattered wider than this around their line make none", 0.001,
     1, at<&FrontendConfig::max_line_rms_m>},
    {"frontend", "min_incidence_rad", "rad",
     "lines that the beams meet at a flatter angle, in the mean, are none", 0, 1.57,
     at<&FrontendConfig::min_incidence_rad>},
    {"frontend", "wall_sigma_m", "m", "walls are not ideal lines: added to the error of their distance",
     0.0001, 1, at<&FrontendConfig::wall_sigma_m>},
    {"frontend", "wall_sigma_rad", "rad", "walls are not ideal lines: added to the error of their direction",
     0.0001, 1, at<&FrontendConfig::wall_sigma_rad>},
    {"frontend", "association_error_m", "m",
     "summed distance of both end points from the wall (epsilon of eq. 5)", 0.001, 5,
     at<&FrontendConfig::association_error_m>},
    {"frontend", "association_gap_m", "m",
     "how far two segments may miss each other and still overlap (eq. 8)", 0, 10,
     at<&FrontendConfig::association_gap_m>},
    {"frontend", "association_mahalanobis2", "",
     "squared Mahalanobis distance of the lines at most (2 degrees of freedom)", 0.01, 1000,
     at<&FrontendConfig::association_mahalanobis2>},
    {"frontend", "association_keyframes", "",
     "a wall not seen within this many keyframes is not associated; at most window_keyframes", 1,
     double{kMaxKeyframeWindow}, at<&FrontendConfig::association_keyframes>},
    {"frontend", "align_to_walls", "", "new walls run along the axis that a building's walls share", 0, 0,
     at<&FrontendConfig::align_to_walls>},
    {"frontend", "window_keyframes", "", "keyframes optimised at once (fixed lag)", 2,
     double{kMaxKeyframeWindow}, at<&FrontendConfig::window_keyframes>},
    {"frontend", "solver_iterations", "", "Levenberg-Marquardt steps at most", 1, 100,
     at<&FrontendConfig::solver_iterations>},
    {"frontend", "chi_square_confidence", "", "confidence of the consistency check (eq. 19)", 0.5, 0.999999,
     at<&FrontendConfig::chi_square_confidence>},
    {"backend", "submap_length_m", "m", "a submap covers this much travel", 0.5, 1000,
     at<&BackendConfig::submap_length_m>},
    {"backend", "grid_resolution_m", "m", "cell size of submaps", 0.01, 1,
     at<&BackendConfig::grid_resolution_m>},
    {"backend", "hit_probability", "", "p(occupied given that a beam ended here)", 0.501, 0.999,
     at<&BackendConfig::hit_probability>},
    {"backend", "miss_probability", "", "p(occupied given that a beam passed through)", 0.001, 0.499,
     at<&BackendConfig::miss_probability>},
    {"backend", "max_kernel_cells", "", "width of the max kernel (eq. 22), odd; 1 is eq. 21, no kernel", 1,
     15, at<&BackendConfig::max_kernel_cells>},
    {"backend", "close_loops", "", "false: the frontend alone, a baseline", 0, 0,
     at<&BackendConfig::close_loops>},
    {"backend", "multiscan_length_m", "m", "the recent travel that is matched against submaps", 0.5, 1000,
     at<&BackendConfig::multiscan_length_m>},
    {"backend", "match_every_keyframes", "", "look for loops at every n-th keyframe", 1, 1000,
     at<&BackendConfig::match_every_keyframes>},
    {"backend", "min_travel_between_m", "m", "travel between the two ends of a closure", 0, 10000,
     at<&BackendConfig::min_travel_between_m>},
    {"backend", "search_radius_m", "m", "widest search around the predicted position", 0.1, 50,
     at<&BackendConfig::search_radius_m>},
    {"backend", "search_angle_rad", "rad", "widest search around the predicted heading", kMinSearchAngleRad,
     kPi, at<&BackendConfig::search_angle_rad>},
    {"backend", "max_candidates", "", "submaps searched per keyframe at most, the most overlapping first", 1,
     1000, at<&BackendConfig::max_candidates>},
    {"backend", "min_score", "", "mean probability under the scan's points that makes a closure", 0.01, 0.99,
     at<&BackendConfig::min_score>},
    {"backend", "min_group_score", "", "... that makes one together with others that agree", 0.01, 0.99,
     at<&BackendConfig::min_group_score>},
    {"backend", "min_match_points", "", "fewer points decide nothing", 3, 100000,
     at<&BackendConfig::min_match_points>},
    {"backend", "align_to_walls", "", "hold the heading by the axis that a building's walls share", 0, 0,
     at<&BackendConfig::align_to_walls>},
    {"backend", "dcs_phi", "", "closures whose chi-square exceeds this are scaled down (DCS)", 0.001, 1000000,
     at<&BackendConfig::dcs_phi>},
    {"backend", "drop_scale", "", "closures scaled below this in the final pass are dropped", 0, 0.99,
     at<&BackendConfig::drop_scale>},
    {"backend", "optimizer_iterations", "",
     "Gauss-Newton steps at most; while flying never more than 4 a keyframe", 1, 1000,
     at<&BackendConfig::optimizer_iterations>},
    {"backend", "refine", "", "false: poses between keyframes stay interpolated, while flying and at the end",
     0, 0, at<&BackendConfig::refine>},
    {"backend", "refinement_iterations", "", "rounds of walls and poses at most, at the end of a run", 1,
     1000, at<&BackendConfig::refinement_iterations>},
    {"backend", "max_scans", "",
     "with more than these, scans of space that others know as well are forgotten", 1000, 100000000,
     at<&BackendConfig::max_scans>},
    {"map", "resolution_m", "m", "cell size of the map that is published and written", 0.01, 1,
     at<&MapConfig::resolution_m>},
    {"map", "hit_log_odds", "", "what one beam's end adds to its cell", 0.01, 10,
     at<&MapConfig::hit_log_odds>},
    {"map", "miss_log_odds", "", "what one beam adds to each cell it passes through", -10, -0.001,
     at<&MapConfig::miss_log_odds>},
    {"map", "clear_range_m", "m", "beams clear cells up to this distance at most", 0.1, 100,
     at<&MapConfig::clear_range_m>},
    {"publish", "status_period_s", "s",
     "between two status messages; walls and the map's summary go with them", 0.05, 3600,
     at<&PublishConfig::status_period_s>},
    {"publish", "tile_refresh_period_s", "s",
     "every tile is sent again at least this often, for late joiners", 0.1, 3600,
     at<&PublishConfig::tile_refresh_period_s>},
    {"publish", "channel_prefix", "", "what every channel's name begins with", 0, 0,
     at<&PublishConfig::channel_prefix>},
    {"record", "enabled", "", "radio, cable and UDP are recorded unless --no-record says otherwise", 0, 0,
     at<&RecordConfig::enabled>},
    {"record", "directory", "", "where recordings go; empty: the state directory", 0, 0,
     at<&RecordConfig::directory>},
    {"record", "max_file_mb", "MB",
     "a recording that has grown this long is continued in a new file; at most max_total_mb", 1, 4000,
     at<&RecordConfig::max_file_mb>},
    {"record", "max_total_mb", "MB",
     "the oldest recordings in the directory are removed so that no more than this is used", 1, 1000000,
     at<&RecordConfig::max_total_mb>},
    {"realtime", "pose_deadline_s", "s",
     "from the radio frame to the published pose; what takes longer is counted", 0.00001, 10,
     at<&RealtimeConfig::pose_deadline_s>},
    {"realtime", "radio_priority", "", "SCHED_FIFO priority of the thread; 0: like any other program", 0, 99,
     at<&RealtimeConfig::radio_priority>},
    {"realtime", "frontend_priority", "", "the same", 0, 99, at<&RealtimeConfig::frontend_priority>},
    {"realtime", "publisher_priority", "", "the same", 0, 99, at<&RealtimeConfig::publisher_priority>},
    {"realtime", "radio_cpu", "", "the only processor the thread runs on; -1: any", -1, 1023,
     at<&RealtimeConfig::radio_cpu>},
    {"realtime", "frontend_cpu", "", "the same", -1, 1023, at<&RealtimeConfig::frontend_cpu>},
    {"realtime", "backend_cpu", "", "the same", -1, 1023, at<&RealtimeConfig::backend_cpu>},
    {"realtime", "publisher_cpu", "", "the same", -1, 1023, at<&RealtimeConfig::publisher_cpu>},
    {"realtime", "lock_memory", "", "nothing is ever swapped out or read in again; stacks are touched first",
     0, 0, at<&RealtimeConfig::lock_memory>},
};

std::string range_problem(const ConfigurationField& field, double value) {
  if (std::isfinite(value) && value >= field.lowest && value <= field.highest) return {};
  return fmt::format("{}.{} = {}: must lie between {} and {}", field.section, field.key, value, field.lowest,
                     field.highest);
}

struct Problem {
  const ConfigurationField& field;

  std::string operator()(const bool*) const { return {}; }
  std::string operator()(const int* value) const { return range_problem(field, *value); }
  std::string operator()(const double* value) const { return range_problem(field, *value); }
  std::string operator()(const std::optional<double>* value) const {
    return *value ? range_problem(field, **value) : std::string();
  }
  std::string operator()(const std::string*) const { return {}; }
};

}  // namespace

std::span<const ConfigurationField> configuration_fields() { return kFields; }

std::string field_problem(const ConfigurationField& field, Configuration& config) {
  return std::visit(Problem{field}, field.in(config));
}

}  // namespace swiftlet
