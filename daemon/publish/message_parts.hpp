// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "swiftlet/pose2d_t.hpp"

namespace swiftlet {

// What several publishers put into their messages.

[[nodiscard]] inline std::int64_t to_utime(HostTime at) {
  return std::chrono::duration_cast<std::chrono::microseconds>(at.time_since_epoch()).count();
}

[[nodiscard]] inline pose2d_t pose2d_message(HostTime at, const Pose2& pose) {
  pose2d_t message;
  message.utime = to_utime(at);
  message.x = static_cast<float>(pose.x_m());
  message.y = static_cast<float>(pose.y_m());
  message.theta = static_cast<float>(pose.yaw_rad());
  return message;
}

}  // namespace swiftlet
