// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/tum_file.hpp"

#include <cmath>

#include "firmware_link/sample/attitude.hpp"

namespace swiftlet {
namespace {

constexpr double kLengthTolerance = 1e-3;

double quaternion_length(const NumberRow& row) {
  return std::hypot(std::hypot(row.value[4], row.value[5]), std::hypot(row.value[6], row.value[7]));
}

/// Exactly of length 1.
Quaternion rotation_in(const NumberRow& row) {
  const double length = quaternion_length(row);
  return {row.value[4] / length, row.value[5] / length, row.value[6] / length, row.value[7] / length};
}

}  // namespace

bool has_unit_quaternion(const NumberRow& row) {
  return std::abs(quaternion_length(row) - 1.0) <= kLengthTolerance;
}

Result<std::vector<StampedPose>> read_tum_file(const std::string& path) {
  const Result<std::vector<NumberRow>> rows = read_number_rows(path);
  if (!rows) return rows.error();
  std::vector<StampedPose> poses;
  poses.reserve(rows->size());
  for (const NumberRow& row : *rows) {
    const Result<HostTime> stamp = stamp_in(row, 0, path);
    if (!stamp) return stamp.error();
    if (!has_unit_quaternion(row))
      return error_in_line(path, row.line,
                           "columns 5 to 8 are no quaternion of length 1; is this a TUM trajectory?");
    poses.push_back({*stamp, Pose2(row.value[1], row.value[2], yaw_of(rotation_in(row)))});
  }
  return poses;
}

}  // namespace swiftlet
