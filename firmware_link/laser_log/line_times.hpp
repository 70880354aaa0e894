// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/laser_log/carmen_log.hpp"

namespace swiftlet {

/// Stamps farther apart are a pause: nothing is known of the time between.
inline constexpr Duration kLongestLineInterval = std::chrono::seconds(5);

/// When the scans of a log were measured. Scanners measure at regular intervals; programs that log them pass
/// lines on in bunches, and a velocity over such stamps is none. Each time is the mean of the stamps around,
/// as many on either side, which keeps regular stamps as they are; pauses are not averaged over. `lines`: in
/// the order of their stamps. The result is as long, and in the same order. Allocates.
[[nodiscard]] std::vector<DeviceTime> regular_times(std::span<const CarmenOdometry> lines);

}  // namespace swiftlet
