// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <span>
#include <vector>

#include "core/backend/refinement/poses_and_walls.hpp"
#include "core/backend/refinement/rigid_nodes.hpp"
#include "core/base/go_on.hpp"
#include "core/base/result.hpp"
#include "core/calibration/calibration_scan.hpp"
#include "core/sensing/sensor_model.hpp"
#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {

/// The systematic errors of the sensors, as estimated from a run.
struct JointEstimate {
  SystematicErrors errors = SystematicErrors::Zero();
  SystematicErrors sigma = SystematicErrors::Zero();  ///< standard deviations
  std::size_t patches = 0;                            ///< stretches of wall seen often enough
  std::size_t returns_on_them = 0;                    ///< of the run's hits
  double wall_sigma_m = 0.0;                          ///< scatter of those around their walls, robust
};

struct JointProblemTuning {
  int associations = 5;
  int steps_per_association = 3;
  int steps_per_noise = 3;
  double settled = 0.05;         ///< of a standard deviation
  double sampling_share = 0.05;  ///< of an interval; as seen in simulated flights
  double noise_factor = 2.0;     ///< the odometry's noise may be so many times larger or smaller
  Duration stretch = std::chrono::seconds(10);
  /// What is possible at all, in the order of SystematicError.
  std::array<double, kSystematicErrors> prior_sigma{0.3, 0.3, 0.3, radians(20.0), 0.3, radians(2.0)};
  RigidNodesTuning nodes{.way_m = 0.25};  ///< a few numbers of the whole input need no finer path
  PosesAndWalls::Tuning problem;
};

/// From the path, the walls and the systematic errors as unknowns of one problem (PosesAndWalls). Patches are
/// found again as the path converges.
///
/// Standard deviations follow from the scatter of the gradients of stretches of ten seconds (a sandwich
/// estimate with clusters, Liang & Zeger 1986), which allows any correlation within a stretch; never less
/// than the model's own; plus the effects of the odometry's noise model, of its sampling and of incomplete
/// convergence.
///
/// `T_map_body`: one pose per scan, close enough that traversals over one wall lie within a decimetre.
/// Errors: kSolver; kTimeout where `go_on` returned false. Allocates. Repeatable. Precondition: two scans.
[[nodiscard]] Result<JointEstimate> estimate_jointly(std::span<const CalibrationScan> scans,
                                                     const SensorModel& sensor,
                                                     std::span<const Pose2> T_map_body, const GoOn& go_on,
                                                     const JointProblemTuning& tuning = {});

}  // namespace swiftlet
