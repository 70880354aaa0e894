// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>

#include "core/base/time.hpp"

namespace swiftlet {

/// A vehicle that flies is unwatched after so long without dead reckoning. In less nobody can carry it away,
/// and it cannot boot.
inline constexpr Duration kUnwatchedAfter = std::chrono::seconds(1);

/// Dead reckoning that moves faster errs.
inline constexpr double kTopSpeedMPerS = 5.0;

}  // namespace swiftlet
