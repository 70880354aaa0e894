// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/backend/pose_graph/pose_graph.hpp"

namespace swiftlet {

/// The graph as g2o reads it: a VERTEX_SE2 for each keyframe (frame map; m, rad), FIX for the first, an
/// EDGE_SE2 for each motion and loop closure that still counts, with the upper triangle of its information as
/// the run weighted it at the end (DCS). Headings by the building's axis have no counterpart there and are
/// left out.
[[nodiscard]] std::string g2o_text(const PoseGraph& graph);

}  // namespace swiftlet
