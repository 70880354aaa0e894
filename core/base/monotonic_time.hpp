// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>

namespace swiftlet {

/// The machine's monotonic time: for pacing, periods and latencies, never for data.
using MonotonicTime = std::chrono::steady_clock::time_point;

}  // namespace swiftlet
