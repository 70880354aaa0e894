// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A true motion: T_first_second between two stamps.
struct Relation {
  HostTime first{};
  HostTime second{};
  Pose2 T_first_second;
};

/// Mean, standard deviation (of the whole population) and maximum.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
  double max = 0.0;
};

/// Errors of motions. Without any, all is 0.
struct MotionError {
  std::size_t count = 0;
  Spread translation_m;  ///< of the lengths of the translational parts
  Spread rotation_deg;   ///< of the absolute rotational parts
};

/// Errors of an estimated path against true motions: all of them and by the time they span.
struct RelationError {
  MotionError all;
  MotionError under_3_s;
  MotionError from_3_to_100_s;  ///< 3 s included, 100 s excluded
  MotionError over_100_s;       ///< 100 s included
  std::size_t missed = 0;       ///< relations of which a stamp has no pose: in none of the above
  StampMatching stamps;         ///< of all relations, in the path
  /// Of each relation, in order; of a missed one none.
  std::vector<std::optional<double>> each_translation_m;
};

/// R. Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009, eq. 4: the
/// error of a relation is its true motion's inverse times the estimated one. Poses are found by
/// StampedPath::nearest().
[[nodiscard]] RelationError relation_error(std::span<const Relation> relations, const StampedPath& path);

}  // namespace swiftlet
