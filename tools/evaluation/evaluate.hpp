// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.hpp"
#include "core/evaluation/map_sharpness.hpp"
#include "core/evaluation/relation_error.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "core/evaluation/trajectory_error.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "tools/evaluation/reference_kind.hpp"

namespace swiftlet {

/// How sharp a flight's walls are along the trajectory, and the report on its capture.
struct FlightResult {
  FlightSharpness sharpness;
  InputReport input;
};

/// A trajectory held against one reference.
struct ReferenceResult {
  std::string file;
  std::variant<RelationError, PathError, FlightResult> figures;
};

struct Evaluation {
  std::string trajectory_file;
  std::size_t poses = 0;
  HostTime first_stamp{};
  HostTime last_stamp{};
  std::vector<ReferenceResult> references;
};

/// Reads the reference and holds the trajectory against it. Errors: kNotFound, kInvalidInput, kDamaged: the
/// file cannot be used. kInvalidInput: none of its stamps is among the trajectory's, which is not empty.
[[nodiscard]] Result<ReferenceResult> evaluate_against(const StampedPath& trajectory, const std::string& file,
                                                       ReferenceKind kind);

}  // namespace swiftlet
