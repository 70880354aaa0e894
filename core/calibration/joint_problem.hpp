// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/calibration/calibration_scan.hpp"
#include "core/calibration/systematic_motion.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// What a run says about the systematic errors of its sensors.
struct JointEstimate {
  SystematicErrors errors = SystematicErrors::Zero();
  SystematicErrors sigma = SystematicErrors::Zero();  ///< standard deviations
  std::size_t patches = 0;                            ///< stretches of wall seen often enough
  std::size_t returns_on_them = 0;                    ///< of the run's hits
  double wall_sigma_m = 0.0;                          ///< scatter of those around their walls, robust
};

/// Called between steps of long work with the share done, 0 to 1; false: stop.
using GoOn = std::function<bool(double done)>;

/// One least-squares problem over all that is unknown together: the pose of every scan, distance and
/// direction of every stretch of wall, and the systematic errors. Returns hold poses to walls, dead reckoning
/// less its systematic errors holds neighbouring scans together. So what walls and ranges leave open of the
/// motion does not traversal for knowledge. Walls are found anew as the poses settle.
///
/// Standard deviations come from the scatter of what stretches of ten seconds say (a sandwich estimate with
/// clusters, Liang & Zeger 1986), so errors within a stretch may be as correlated as they like; never less
/// than the model's own; with the doubts about the odometry's noise, its sampling, and how far all has
/// settled on top.
///
/// `T_map_body`: one pose per scan, close enough that traversals over one wall lie within a decimetre; in and
/// out. Errors: kSolver; kTimeout where `go_on` said no. Allocates. Repeatable. Precondition: two scans.
[[nodiscard]] Result<JointEstimate> estimate_jointly(std::span<const CalibrationScan> scans,
                                                     const SensorModel& sensor,
                                                     std::vector<Pose2>& T_map_body, const GoOn& go_on);

}  // namespace swiftlet
