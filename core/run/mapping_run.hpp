// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/base/go_on.hpp"
#include "core/base/result.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// What samples are mapped with.
struct MappingSettings {
  FrontendConfig frontend{};
  BackendConfig backend{};
  SensorModel sensor{};
};

/// A run through frontend and backend, with the batch refinement.
struct MappingRun {
  std::vector<Pose2> T_map_body;  ///< one per sample
  BackendCounters counters;
};

/// Maps samples in lockstep. Errors: kTimeout where `go_on` returned false. Allocates.
[[nodiscard]] Result<MappingRun> map_samples(std::span<const RangeSample> samples,
                                             const MappingSettings& settings, const BeamLayout& beams,
                                             const GoOn& go_on);

}  // namespace swiftlet
