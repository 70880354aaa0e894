// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "daemon/outputs/run_outputs.hpp"

namespace swiftlet {

/// The places that were marked in the run, in order of time, where they are in the final map: a head, then
/// a line of name, Unix time, x, y and yaw for each. Errors: as for_each_scan().
[[nodiscard]] Result<std::string> places_csv(const RunView& run);

}  // namespace swiftlet
