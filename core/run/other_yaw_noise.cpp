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
  Result<MappingRun> run = map_samples(samples, others, beams, [](double) { return true; });
  if (!run || run->counters.map_source == MapSource::kDeadReckoning) return std::nullopt;
  return OtherPath{factor, std::move(run->T_map_body)};
}

}  // namespace swiftlet
