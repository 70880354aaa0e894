// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/refinement/other_path.hpp"
#include "core/run/mapping_run.hpp"
#include "core/sensing/odometry_calibration.hpp"

namespace swiftlet {

// A run that is mapped once more, otherwise, breaks elsewhere if it breaks, and only the finished map tells
// whether it did. So a run is mapped again with other noise of the heading of dead reckoning (robots differ
// by a factor of four and more) and from its end to its start, and the map that explains the ranges best is
// delivered (RunRefinement::refine_all()). Each takes less time than the run took, and allocates. Paths have
// their poses refined at the end only, over floors as they are reported; there is none where that map is
// dead reckoning alone. `samples`: all of the run. Thread-safe.

/// Times the standard deviation of that noise. docs/decisions/0029-a-run-is-mapped-again.md has what each
/// breaks.
inline constexpr std::array kOtherYawNoise{0.5, 0.7};

[[nodiscard]] std::optional<OtherPath> path_with_yaw_noise(double factor,
                                                           std::span<const RangeSample> samples,
                                                           const MappingSettings& settings,
                                                           const BeamLayout& beams);

/// The run mapped from its last sample to its first: what was taken for a loop on the way there is met with
/// another error. Poses are in the order of `samples`, in a map frame of their own.
[[nodiscard]] std::optional<OtherPath> path_backwards(std::span<const RangeSample> samples,
                                                      const MappingSettings& settings,
                                                      const BeamLayout& beams);

/// `samples` as stretch_steps() leaves them.
[[nodiscard]] std::optional<OtherPath> path_over_known_floor(std::span<const RangeSample> samples,
                                                             const MappingSettings& settings,
                                                             const BeamLayout& beams);

/// As if the vehicle had flown its path from the end to the start, in the same times. A break of motion lies
/// between the same two samples.
[[nodiscard]] std::vector<RangeSample> played_backwards(std::span<const RangeSample> samples);

/// What corrects the steps of a run corrects them so when it is played backwards. Metres and turns change
/// their sign by themselves, seconds do not.
[[nodiscard]] OdometryCalibration calibration_backwards(OdometryCalibration calibration);

/// Makes the step to each sample so many times as long.
void stretch_steps(std::vector<RangeSample>& samples, std::span<const double> step_scale);

}  // namespace swiftlet
