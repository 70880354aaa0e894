// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// One scan as a calibration needs it.
struct CalibrationScan {
  DeviceTime measured_at{};  ///< when its ranges were measured, as far as was assumed
  Pose2 T_odom_body;         ///< the dead reckoning of that time, as measured
  bool starts_segment = false;
  std::vector<Point2> hits_body;
};

/// Allocates.
[[nodiscard]] std::vector<CalibrationScan> calibration_scans(std::span<const RangeSample> samples,
                                                             const BeamLayout& beams);

/// How much a run has of the motions that tell systematic errors, by its dead reckoning.
struct MotionSummary {
  double duration_s = 0.0;
  double forward_m = 0.0;   ///< to and fro: sum of amounts
  double sideways_m = 0.0;  ///< the same to left and right
  double turned_rad = 0.0;  ///< the same of turns
};
[[nodiscard]] MotionSummary summarize_motion(std::span<const CalibrationScan> scans);

}  // namespace swiftlet
