// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/calibration_scan.hpp"

#include <cmath>

namespace swiftlet {

std::vector<CalibrationScan> calibration_scans(std::span<const RangeSample> samples,
                                               const BeamLayout& beams) {
  std::vector<CalibrationScan> scans;
  scans.reserve(samples.size());
  for (const RangeSample& sample : samples) {
    CalibrationScan& scan = scans.emplace_back(
        CalibrationScan{{sample.measured_at, sample.T_odom_body, sample.starts_segment}, {}, sample.storey});
    for (std::size_t beam = 0; beam < sample.beam_count; ++beam) {
      if (sample.status[beam] != RangeStatus::kHit) continue;
      const double distance_m = static_cast<double>(sample.distance_m[beam]);
      scan.hits_body.push_back(
          {distance_m * std::cos(beams.bearing_rad[beam]), distance_m * std::sin(beams.bearing_rad[beam])});
    }
  }
  return scans;
}

MotionSummary summarize_motion(std::span<const CalibrationScan> scans) {
  MotionSummary summary;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (scans[i].starts_segment) continue;
    const Pose2 step = between(scans[i - 1].T_odom_body, scans[i].T_odom_body);
    summary.duration_s += to_seconds(scans[i].measured_at - scans[i - 1].measured_at);
    summary.forward_m += std::abs(step.x_m());
    summary.sideways_m += std::abs(step.y_m());
    summary.turned_rad += std::abs(step.yaw_rad());
  }
  return summary;
}

}  // namespace swiftlet
