// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/cross_check.hpp"

#include <cstdint>
#include <span>

#include "core/geometry/cell_numbers.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kEven = 128;  // of occupied and free

}  // namespace

std::vector<Point2> thinned_hits(const ScanStore& scans, const KeyframeChain& chain, const ScanRange& in,
                                 const KeyframePoses& T_w_keyframe, const Pose2& T_frame_w, double cell_m) {
  std::vector<Point2> points;
  const std::vector<Pose2> T_w_body = chain.T_w_bodies(in, T_w_keyframe);
  CellNumbers cells(cell_m);
  cells.reset(scans.return_count(in));
  const std::span<const StoredScan> stored = scans.all().values(in);
  for (std::size_t i = stored.size(); i-- > 0;) {
    const Pose2 T_frame_body = T_frame_w * T_w_body[i];
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (!beam.is_hit) continue;
      const Point2 p = T_frame_body * scans.point_body(beam);
      if (cells.is_first(p)) points.push_back(p);
    }
  }
  return points;
}

Submap CrossCheck::draw_recent() const {
  const IdMap<KeyframeId, ScanId>& keyframes = chain_.all();
  KeyframeId first = query_;
  while (first > keyframes.first_id() && chain_.scan_of(keyframes.previous(first)) >= recent_.first)
    first = keyframes.previous(first);
  BackendConfig config = config_;
  config.max_kernel_cells = config_.tuning.cross_check.kernel_cells;
  return build_submap(first, query_, scans_, chain_, T_w_keyframe_, config);
}

bool CrossCheck::holds(const Submap& submap, const Pose2& T_submap_query) {
  if (!drawn_) drawn_ = draw_recent();
  const Pose2 T_drawn_query = between(T_w_keyframe_[drawn_->reference], T_w_keyframe_[query_]);
  const Pose2 T_drawn_w =
      T_drawn_query * T_submap_query.inverse() * T_w_keyframe_[submap.reference].inverse();
  std::size_t seen = 0;
  std::size_t on_walls = 0;
  const GridGeometry& grid = drawn_->geometry;
  for (const Point2& p : thinned_hits(scans_, chain_, submap.scans, T_w_keyframe_, T_drawn_w,
                                      config_.tuning.detector.thinning_cell_m)) {
    const CellIndex cell = grid.cell(p);
    if (!grid.contains(cell)) continue;
    const std::uint8_t occupied = drawn_->cells[grid.offset(cell)];
    seen += occupied != 0 ? 1 : 0;
    on_walls += occupied >= kEven ? 1 : 0;
  }
  const CrossCheckTuning& tuning = config_.tuning.cross_check;
  return seen >= tuning.min_seen_hits &&
         static_cast<double>(on_walls) >= tuning.min_share_on_walls * static_cast<double>(seen);
}

}  // namespace swiftlet
