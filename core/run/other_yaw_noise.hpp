// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/backend/refinement/other_path.hpp"
#include "core/run/mapping_run.hpp"

namespace swiftlet {

// How much the heading of dead reckoning errs differs between robots, by a factor of four and more, and only
// the finished map tells whether what was assumed was right. So a run is mapped again with other factors of
// that noise, and the map that explains the ranges best is delivered (RunRefinement::refine_all()).

/// Of its standard deviations, a step of 1.4 from one to the next. At a quarter and at twice most long laser
/// logs break; between those, which copies break differs from factor to factor.
inline constexpr std::array kOtherYawNoise{0.5, 0.7, 1.4};

/// The final path with so many times the noise; nothing where that map is dead reckoning alone.
/// `samples`: all of the run. Poses are refined at the end only, over floors as they are reported. Allocates;
/// takes less time than the run took. Thread-safe.
[[nodiscard]] std::optional<OtherPath> path_with_yaw_noise(double factor,
                                                           std::span<const RangeSample> samples,
                                                           const MappingSettings& settings,
                                                           const BeamLayout& beams);

/// Makes the step to each sample so many times as long.
void stretch_steps(std::vector<RangeSample>& samples, std::span<const double> step_scale);

}  // namespace swiftlet
