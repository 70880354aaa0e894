// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/scan_drawing.hpp"

#include <cmath>

namespace swiftlet {

namespace {

constexpr double kFarthestM = 1e5;  // cells of 1 cm and lattice steps of 1/4 of it still fit an int32

}  // namespace

ScanDrawing::ScanDrawing(const MapConfig& config, double clear_range_m, double max_range_m)
    : cells_per_m_(1.0 / config.resolution_m),
      clear_range_m_(clear_range_m),
      position_step_m_(config.resolution_m / config.tuning.drawing.lattice_per_cell),
      yaw_step_rad_(position_step_m_ / max_range_m),
      store_(config) {}

std::optional<ScanDrawing::LatticePose> ScanDrawing::rounded(const Pose2& T_map_body) const {
  const bool drawable = std::abs(T_map_body.x_m()) < kFarthestM && std::abs(T_map_body.y_m()) < kFarthestM &&
                        std::isfinite(T_map_body.yaw_rad());
  if (!drawable) return std::nullopt;
  return LatticePose{static_cast<std::int32_t>(std::lround(T_map_body.x_m() / position_step_m_)),
                     static_cast<std::int32_t>(std::lround(T_map_body.y_m() / position_step_m_)),
                     static_cast<std::int32_t>(std::lround(T_map_body.yaw_rad() / yaw_step_rad_))};
}

bool ScanDrawing::needs_drawing(ScanId scan, const Pose2& T_map_body) const {
  return scan >= drawn_.end_id() || drawn_[scan] != rounded(T_map_body);
}

void ScanDrawing::draw(ScanId scan, const Pose2& T_map_body, const DrawnBeams& beams) {
  if (!needs_drawing(scan, T_map_body)) return;
  rub_out(scan, beams);
  std::optional<LatticePose>& drawn = drawn_[scan];
  drawn = rounded(T_map_body);
  if (drawn) apply(*drawn, beams, TileStore::Change::kCount);
}

void ScanDrawing::rub_out(ScanId scan, const DrawnBeams& beams) {
  while (drawn_.end_id() <= scan) drawn_.push_back({});
  std::optional<LatticePose>& drawn = drawn_[scan];
  if (drawn) apply(*drawn, beams, TileStore::Change::kTakeBack);
  drawn.reset();
}

void ScanDrawing::apply(const LatticePose& pose, const DrawnBeams& beams, TileStore::Change change) {
  store_.enter(beams.storey);
  const Pose2 T_map_body(pose.x * position_step_m_, pose.y * position_step_m_, pose.yaw * yaw_step_rad_);
  for (const BeamEnd& beam : beams.ends) apply_beam(T_map_body, beam, change);
}

void ScanDrawing::apply_beam(const Pose2& T_map_body, const BeamEnd& beam, TileStore::Change change) {
  const auto in_cells = [&](const Point2& p_body) {
    const Point2 p_map = T_map_body * p_body;
    return Point2{p_map.x_m * cells_per_m_, p_map.y_m * cells_per_m_};
  };
  const Point2 start = in_cells({});
  const Point2 end = in_cells(beam.end_body);
  const double length_m = std::hypot(beam.end_body.x_m, beam.end_body.y_m);
  Point2 clear_end = end;
  if (length_m > clear_range_m_) {
    const double share = clear_range_m_ / length_m;
    clear_end = in_cells({beam.end_body.x_m * share, beam.end_body.y_m * share});
  }
  walk_ray(start, clear_end, [&](CellIndex cell) { store_.add_miss(cell, change); });
  if (beam.is_hit) store_.add_hit(cell_of(end), change);
}

}  // namespace swiftlet
