// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

#include "core/backend/backend.hpp"
#include "core/run/mapping_run.hpp"

namespace swiftlet {

/// The run so far with each of kOtherYawNoise and backwards, each on a thread of its own; or once, with steps
/// of other lengths (MapAgain). Empty where that is not wanted or scans were pruned. The same paths whatever
/// the threads do. Takes about as long as the run took so far, and the memory of a backend for each.
[[nodiscard]] std::vector<OtherPath> map_again(const Backend& backend, const MappingSettings& settings,
                                               std::span<const double> step_scale);

}  // namespace swiftlet
