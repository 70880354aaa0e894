// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
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

/// Groups returns on the same stretch of wall, about half a metre long. The two faces of a thin wall are two
/// patches. Of `fit`, `tuning` replaces what a wall needs at least. Allocates. Repeatable.
[[nodiscard]] WallPatches find_wall_patches(std::span<const DrawnReturn> returns,
                                            const WallFitTuning& fit = {},
                                            const WallPatchesTuning& tuning = {});

}  // namespace swiftlet
