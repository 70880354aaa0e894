// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/relation_error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace swiftlet {
namespace {

constexpr Duration kStampTolerance = std::chrono::milliseconds(2);

/// The pose stamped nearest.
std::optional<Pose2> pose_at(HostTime time, std::span<const HostTime> stamps,
                             std::span<const Pose2> T_map_body) {
  if (stamps.empty()) return std::nullopt;
  auto nearest = std::lower_bound(stamps.begin(), stamps.end(), time);
  if (nearest == stamps.end() || (nearest != stamps.begin() && time - *(nearest - 1) <= *nearest - time))
    --nearest;
  if (std::chrono::abs(*nearest - time) > kStampTolerance) return std::nullopt;
  return T_map_body[static_cast<std::size_t>(nearest - stamps.begin())];
}

}  // namespace

std::vector<Relation> read_relations(std::istream& lines) {
  std::vector<Relation> relations;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    double t1 = 0.0, t2 = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0, roll = 0.0, pitch = 0.0, yaw_rad = 0.0;
    if (fields >> t1 >> t2 >> x_m >> y_m >> z_m >> roll >> pitch >> yaw_rad)
      relations.push_back({HostTime(from_seconds(t1)), HostTime(from_seconds(t2)), Pose2(x_m, y_m, yaw_rad)});
  }
  return relations;
}

RelationError relation_error(std::span<const Relation> relations, std::span<const HostTime> stamps,
                             std::span<const Pose2> T_map_body) {
  RelationError error;
  for (const Relation& relation : relations) {
    const std::optional<Pose2> first = pose_at(relation.first, stamps, T_map_body);
    const std::optional<Pose2> second = pose_at(relation.second, stamps, T_map_body);
    if (!first || !second) {
      ++error.missed;
      continue;
    }
    const Pose2 off = between(relation.T_first_second, between(*first, *second));
    error.mean_m += std::hypot(off.x_m(), off.y_m());
    error.mean_deg += degrees(std::abs(off.yaw_rad()));
    ++error.matched;
  }
  if (error.matched == 0) return error;
  error.mean_m /= static_cast<double>(error.matched);
  error.mean_deg /= static_cast<double>(error.matched);
  return error;
}

}  // namespace swiftlet
