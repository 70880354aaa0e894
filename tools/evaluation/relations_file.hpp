// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/evaluation/relation_error.hpp"

namespace swiftlet {

/// Reads true motions in the format of Kuemmerle et al. 2009, lines of `t1 t2 x y z roll pitch yaw` in
/// seconds, metres and radians: the pose at t2 seen from that at t1; of motions in space x, y and yaw.
/// Errors: as read_number_rows(); kInvalidInput: a stamp that is none, by file and line.
[[nodiscard]] Result<std::vector<Relation>> read_relations_file(const std::string& path);

}  // namespace swiftlet
