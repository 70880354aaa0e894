// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A return drawn in the map.
struct DrawnReturn {
  Point2 p_map;
  Point2 direction_map;  ///< unit, of the beam
};

/// A short straight stretch of one face of a wall, with many returns on it.
struct WallPatch {
  Point2 center_map;
  Point2 normal_map;  ///< unit, towards the sensor
};

struct WallPatches {
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<WallPatch> patches;
  std::vector<std::uint32_t> patch_of;  ///< of each return; kNone where it lies on no clear line
};

struct WallPatchesTuning {
  double cell_m = 0.5;       ///< a patch lies in one cell
  double neighbour_m = 0.3;  ///< how far around a return its wall is looked for
  std::size_t min_neighbours = 6;
  double min_length_m2 = 0.003;  ///< variance along the wall: shorter stretches have no direction
  double max_ratio = 0.35;       ///< variance across to variance along: more is clutter
  double max_off_m = 0.12;       ///< of a return from its patch
  double min_agreement = 0.9;    ///< cosine between two normals of one patch
  std::size_t min_returns = 8;
};

/// Groups returns on the same stretch of wall, about half a metre long. The two faces of a thin wall are two
/// patches. Allocates. Repeatable.
[[nodiscard]] WallPatches find_wall_patches(std::span<const DrawnReturn> returns,
                                            const WallPatchesTuning& tuning = {});

}  // namespace swiftlet
