// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>

#include "core/base/result.hpp"
#include "core/calibration/joint_problem.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct StretchEstimateTuning {
  std::size_t scans = 3000;         ///< of the run, at most
  std::size_t stretch_scans = 600;  ///< of one stretch
  std::size_t hits_of_scan = 8;     ///< at most, in turn
  JointProblemTuning joint;
};

/// The systematic errors of the sensors from stretches spread evenly over a run, at a cost that hardly grows
/// with it. Walls that are seen again within a stretch show age and scales; so each stretch follows a
/// frontend of its own, and no loop is closed. Errors: kSolver. Allocates. Repeatable. Precondition: two
/// samples.
[[nodiscard]] Result<JointEstimate> estimate_from_stretches(std::span<const RangeSample> samples,
                                                            const SensorModel& sensor,
                                                            const BeamLayout& beams,
                                                            const StretchEstimateTuning& tuning = {});

}  // namespace swiftlet
