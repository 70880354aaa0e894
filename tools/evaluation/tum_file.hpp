// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/stamped_pose.hpp"
#include "tools/evaluation/number_rows.hpp"

namespace swiftlet {

/// Whether the last four columns are a rotation: of length 1, give or take the rounding of a few digits.
[[nodiscard]] bool has_unit_quaternion(const NumberRow& row);

/// Reads a TUM trajectory, lines of `stamp x y z qx qy qz qw`, in the order of the file; of poses in space
/// position and heading in the plane. Errors: as read_number_rows(); kInvalidInput: a stamp or quaternion
/// that is none, by file and line.
[[nodiscard]] Result<std::vector<StampedPose>> read_tum_file(const std::string& path);

}  // namespace swiftlet
