// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/refinement/poses_and_walls.hpp"
#include "core/backend/refinement/wall_patches.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// Which returns of a simulated flight are on the same face of a wall, known from its true path. It is known
/// at whatever poses they are drawn. All that is told of the walls beside is that they are straight, and
/// about where those point that are too short to show it.
class TrueWalls {
 public:
  /// `T_world_body`: true pose of each scan.
  TrueWalls(std::span<const WallSegment> walls, std::span<const ScanHit> hits,
            std::span<const Pose2> T_world_body);

  /// A patch for each face that was seen, as long as it is: the line through its returns as they are drawn.
  /// `drawn` in the order of the hits.
  [[nodiscard]] WallPatches drawn_by(std::span<const DrawnReturn> drawn, const WallFitTuning& fit) const;

 private:
  std::vector<Point2> normals_world_;   // of each face, to the side from which it is seen
  std::vector<std::uint32_t> face_of_;  // of each hit; WallPatches::kNone
};

}  // namespace swiftlet
