// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"
#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {

/// A scan as input of a calibration.
struct CalibrationScan : TimedOdometry {
  std::vector<Point2> hits_body;
  StoreyId storey{};
};

/// Allocates.
[[nodiscard]] std::vector<CalibrationScan> calibration_scans(std::span<const RangeSample> samples,
                                                             const BeamLayout& beams);

/// Without the hits. Allocates.
[[nodiscard]] inline std::vector<TimedOdometry> odometry_of(std::span<const CalibrationScan> scans) {
  return {scans.begin(), scans.end()};
}

/// Amounts of motion, by dead reckoning, from which systematic errors are estimated.
struct MotionSummary {
  double duration_s = 0.0;
  double forward_m = 0.0;   ///< to and fro: sum of amounts
  double sideways_m = 0.0;  ///< the same to left and right
  double turned_rad = 0.0;  ///< the same of turns
};
[[nodiscard]] MotionSummary summarize_motion(std::span<const CalibrationScan> scans);

}  // namespace swiftlet
