// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <istream>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A true motion: T_first_second between two stamps.
struct Relation {
  HostTime first{};
  HostTime second{};
  Pose2 T_first_second;
};

/// Reads lines of `t1 t2 x y z roll pitch yaw`, seconds, metres and radians.
std::vector<Relation> read_relations(std::istream& lines);

/// How an estimated path disagrees with the relations.
struct RelationError {
  std::size_t matched = 0;
  std::size_t missed = 0;  ///< no pose within 2 ms of a stamp
  double mean_m = 0.0;     ///< of the translational parts
  double mean_deg = 0.0;   ///< of the absolute rotational parts
};

/// R. Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009, eq. 4: the
/// error of a relation is its true motion's inverse times the estimated one. `stamps`, ascending, are those
/// of `T_map_body`. Precondition: same size.
RelationError relation_error(std::span<const Relation> relations, std::span<const HostTime> stamps,
                             std::span<const Pose2> T_map_body);

}  // namespace swiftlet
