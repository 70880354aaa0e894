// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdio>
#include <string>

namespace swiftlet {

/// A FLASER line with odometry (x, 0.2, 0.3) and ranges from first_m up in steps of 1 cm.
inline std::string flaser_line(int readings, double x_m, const std::string& stamp, double first_m = 1.0) {
  std::string line = "FLASER " + std::to_string(readings);
  char number[64];
  for (int i = 0; i < readings; ++i) {
    std::snprintf(number, sizeof number, " %.2f", first_m + 0.01 * i);
    line += number;
  }
  std::snprintf(number, sizeof number, " 9 9 9 %.6f 0.2 0.3 ", x_m);
  return line + number + stamp + " host " + stamp + "\n";
}

inline std::string odometry_line(double x_m, double y_m, double yaw_rad, const std::string& stamp) {
  char pose[96];
  std::snprintf(pose, sizeof pose, "ODOM %.6f %.6f %.6f 0 0 0 ", x_m, y_m, yaw_rad);
  return pose + stamp + " host " + stamp + "\n";
}

/// A ROBOTLASER1 or RAWLASER1 line: what stands before the readings, readings from 1 m up in steps of 1 cm,
/// what stands behind them.
inline std::string scan_line(const std::string& kind, const std::string& before, int readings,
                             const std::string& behind, const std::string& stamp) {
  std::string line = kind + " " + before;
  char number[32];
  for (int i = 0; i < readings; ++i) {
    std::snprintf(number, sizeof number, " %.2f", 1.0 + 0.01 * i);
    line += number;
  }
  return line + " " + behind + " " + stamp + " host " + stamp + "\n";
}

}  // namespace swiftlet
