// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/backend/backend.hpp"

namespace swiftlet {

/// One line each on what the final map follows, where it is not the usual.
[[nodiscard]] std::vector<std::string> map_notes(const BackendCounters& counters);

}  // namespace swiftlet
