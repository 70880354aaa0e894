// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/tum_trajectory.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace swiftlet {

void append_tum_line(std::string& text, HostTime stamp, const Pose2& pose) {
  constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
  const std::int64_t us = std::chrono::round<std::chrono::microseconds>(stamp.time_since_epoch()).count();
  const std::uint64_t magnitude = us < 0 ? static_cast<std::uint64_t>(-us) : static_cast<std::uint64_t>(us);
  char line[256];
  const int size =
      std::snprintf(line, sizeof line, "%s%llu.%06llu %.6f %.6f 0 0 0 %.9f %.9f\n", us < 0 ? "-" : "",
                    static_cast<unsigned long long>(magnitude / kMicrosecondsPerSecond),
                    static_cast<unsigned long long>(magnitude % kMicrosecondsPerSecond), pose.x_m(),
                    pose.y_m(), std::sin(pose.yaw_rad() / 2.0), std::cos(pose.yaw_rad() / 2.0));
  if (size > 0 && static_cast<std::size_t>(size) < sizeof line)
    text.append(line, static_cast<std::size_t>(size));
}

}  // namespace swiftlet
