// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/other_yaw_noise.hpp"

#include <utility>

namespace swiftlet {

std::optional<OtherPath> path_with_yaw_noise(double factor, std::span<const RangeSample> samples,
                                             const MappingSettings& settings, const BeamLayout& beams) {
  MappingSettings others = settings;
  others.sensor.odometry.yaw_rad = settings.sensor.odometry.yaw_rad.scaled(factor);
  others.backend.refine_online = false;
  others.backend.floor_varies = false;
  Result<MappingRun> run = map_samples(samples, others, beams, [](double) { return true; });
  if (!run || run->counters.map_source == MapSource::kDeadReckoning) return std::nullopt;
  return OtherPath{factor, std::move(run->T_map_body)};
}

void stretch_steps(std::vector<RangeSample>& samples, std::span<const double> step_scale) {
  Pose2 T_odom_before;  // as reported
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Pose2 T_odom_body = samples[i].T_odom_body;
    if (i > 0)
      samples[i].T_odom_body =
          samples[i - 1].T_odom_body * stretched(between(T_odom_before, T_odom_body), step_scale[i]);
    T_odom_before = T_odom_body;
  }
}

}  // namespace swiftlet
