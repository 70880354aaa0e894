// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/other_paths.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace swiftlet {
namespace {

std::optional<OtherPath> path(MapSource source, double factor, std::span<const RangeSample> samples,
                              const MappingSettings& settings, const BeamLayout& beams) {
  MappingSettings others = settings;
  others.sensor.odometry.yaw_rad = settings.sensor.odometry.yaw_rad.scaled(factor);
  others.backend.refine_online = false;
  others.backend.floor_varies = false;
  Result<MappingRun> run = map_samples(samples, others, beams, [](double) { return true; });
  if (!run || run->counters.map_source == MapSource::kDeadReckoning) return std::nullopt;
  return OtherPath{source, factor, std::move(run->T_map_body)};
}

}  // namespace

std::optional<OtherPath> path_with_yaw_noise(double factor, std::span<const RangeSample> samples,
                                             const MappingSettings& settings, const BeamLayout& beams) {
  return path(MapSource::kOtherYawNoise, factor, samples, settings, beams);
}

std::optional<OtherPath> path_over_known_floor(std::span<const RangeSample> samples,
                                               const MappingSettings& settings, const BeamLayout& beams) {
  return path(MapSource::kFloorKnown, 1.0, samples, settings, beams);
}

std::optional<OtherPath> path_backwards(std::span<const RangeSample> samples, const MappingSettings& settings,
                                        const BeamLayout& beams) {
  MappingSettings others = settings;
  others.sensor.odometry_calibration = calibration_backwards(settings.sensor.odometry_calibration);
  std::optional<OtherPath> found = path(MapSource::kBackwards, 1.0, played_backwards(samples), others, beams);
  if (found) std::ranges::reverse(found->T_map_body);
  return found;
}

std::vector<RangeSample> played_backwards(std::span<const RangeSample> samples) {
  std::vector<RangeSample> played(samples.rbegin(), samples.rend());
  for (std::size_t i = 0; i < played.size(); ++i) {
    RangeSample& sample = played[i];
    sample.sequence = static_cast<std::uint32_t>(i);
    sample.measured_at = samples.front().measured_at + (samples.back().measured_at - sample.measured_at);
    sample.stamp = samples.front().stamp + (samples.back().stamp - sample.stamp);
    const RangeSample& before = i == 0 ? samples.front() : samples[samples.size() - i];
    sample.starts_segment = before.starts_segment;  // a flag of the step between the two
    sample.odometry_ran_on = before.odometry_ran_on;
  }
  return played;
}

OdometryCalibration calibration_backwards(OdometryCalibration calibration) {
  calibration.yaw_per_second_rad = -calibration.yaw_per_second_rad;
  return calibration;
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
