// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/id_map.hpp"
#include "core/geometry/pose2.hpp"
#include "core/mapping/map_config.hpp"
#include "core/mapping/tile_store.hpp"

namespace swiftlet {

/// One beam to draw: from the body's origin to `end_body`.
struct BeamEnd {
  Point2 end_body;
  bool is_hit = false;  ///< false: nothing up to there, the beam only clears
};

/// Those of one scan.
struct DrawnBeams {
  std::span<const BeamEnd> ends;
  StoreyId storey{};
};

/// Draws scans into a tile store and can move each of them later.
///
/// A scan is drawn at its pose rounded to a lattice of a quarter of a cell (in position, and in what a turn
/// moves at the sensor's range), far below the noise of a reading. So a correction too small to matter costs
/// one comparison, and still what is drawn is a function of each scan's present pose alone: no history of
/// small corrections, and no order among large ones, can leave a trace.
///
/// One thread at a time. Allocates as scans and map grow.
class ScanDrawing {
 public:
  /// `clear_range_m`: beams clear cells up to this distance at most. `max_range_m`: hits lie no farther.
  ScanDrawing(const MapConfig& config, double clear_range_m, double max_range_m);

  /// Whether drawing `scan` at this pose would change anything.
  [[nodiscard]] bool needs_drawing(ScanId scan, const Pose2& T_map_body) const;
  /// Draws `scan` here; where it was drawn elsewhere before, it is rubbed out there first. `beams` and their
  /// storey must be the same at every call for one scan. A pose that is not finite, or over 100 km away,
  /// draws nothing.
  void draw(ScanId scan, const Pose2& T_map_body, const DrawnBeams& beams);

  /// Rubs a scan out.
  void rub_out(ScanId scan, const DrawnBeams& beams);
  /// Forgets scans. Precondition: they were rubbed out.
  void erase(const IdRanges<ScanId>& scans) { drawn_.erase(scans); }

  [[nodiscard]] TileStore& store() { return store_; }
  [[nodiscard]] const TileStore& store() const { return store_; }

 private:
  struct LatticePose {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t yaw = 0;
    bool operator==(const LatticePose&) const = default;
  };
  [[nodiscard]] std::optional<LatticePose> rounded(const Pose2& T_map_body) const;
  void apply(const LatticePose& pose, const DrawnBeams& beams, TileStore::Change change);
  void apply_beam(const Pose2& T_map_body, const BeamEnd& beam, TileStore::Change change);

  double cells_per_m_;
  double clear_range_m_;
  double position_step_m_;
  double yaw_step_rad_;
  TileStore store_;
  IdMap<ScanId, std::optional<LatticePose>> drawn_;  ///< where a scan stands in the store
};

}  // namespace swiftlet
