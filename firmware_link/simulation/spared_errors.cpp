// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/spared_errors.hpp"

#include <algorithm>
#include <string>

#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {

const SparedErrors::Named SparedErrors::kNamed[kErrors] = {
    {"floors", [](VehicleModel& model) { model.odometry.floor_patches.clear(); }},
    {"slips", [](VehicleModel& model) { model.odometry.slips_per_s = 0.0; }},
    {"scale", [](VehicleModel& model) { model.odometry.scale_spread = 0.0; }},
    {"wander", [](VehicleModel& model) { model.odometry.scale_wander = 0.0; }},
    {"flow", [](VehicleModel& model) { model.odometry.velocity_noise_m_s = 0.0; }},
    {"drift",
     [](VehicleModel& model) {
       model.odometry.yaw_bias_min_rad_s = model.odometry.yaw_bias_max_rad_s = 0.0;
       model.odometry.turn_scale_spread = 0.0;
     }},
    {"walk", [](VehicleModel& model) { model.odometry.yaw_walk_rad_sqrt_s = 0.0; }},
    {"jumps", [](VehicleModel& model) { model.odometry.yaw_jumps_per_s = 0.0; }},
    {"sign", [](VehicleModel& model) { model.odometry.loses_reverse_sign = false; }},
    {"ranges",
     [](VehicleModel& model) {
       model.ranger.noise_floor_m = model.ranger.noise_share = 0.0;
       model.ranger.noise_by_range.clear();
       model.ranger.wild_share = model.ranger.phantom_share = 0.0;
     }},
    {"tilt", [](VehicleModel& model) { model.tilt = TiltModel(); }},
    {"lag", [](VehicleModel& model) { model.range_age = VehicleModel().range_age; }},
};

Result<SparedErrors> SparedErrors::parse(std::string_view text) {
  SparedErrors spared;
  do {
    const std::string_view name = cut_off(text, ',');
    const Named* const found = std::ranges::find(kNamed, name, &Named::name);
    if (found == std::end(kNamed)) {
      std::string known;
      for (const Named& error : kNamed) known += (known.empty() ? "" : ", ") + std::string(error.name);
      return bad_address("no error of sensors " + in_quotes(name) + "; there are " + known);
    }
    spared.is_spared_.set(static_cast<std::size_t>(found - kNamed));
  } while (!text.empty());
  return spared;
}

void SparedErrors::take_from(VehicleModel& model) const {
  for (std::size_t k = 0; k < kErrors; ++k)
    if (is_spared_[k]) kNamed[k].take_from(model);
}

}  // namespace swiftlet
