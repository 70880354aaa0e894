// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/cross_check.hpp"

#include <cstdint>

#include "core/geometry/cell_numbers.hpp"

namespace swiftlet {
namespace {

constexpr double kThinningM = 0.1;
constexpr std::size_t kMinSeen = 20;  // hits of the submap; fewer verify nothing
// Right matches seldom have less, false ones in wide windows mostly do.
constexpr double kMinOnWalls = 0.6;
constexpr int kKernelCells = 3;  // two visits draw a wall within a cell of each other; more hides free space
constexpr std::uint8_t kEven = 128;

}  // namespace

std::vector<Point2> thinned_hits(const ScanStore& scans, const KeyframeChain& chain, ScanRange in,
                                 std::span<const Pose2> T_w_keyframe, const Pose2& T_frame_w) {
  std::vector<Point2> points;
  const std::vector<Pose2> T_w_body = chain.T_w_bodies(in, T_w_keyframe);
  CellNumbers cells(kThinningM);
  cells.reset(scans.return_count(in));
  for (ScanIndex i = in.end; i-- > in.first;) {
    const Pose2 T_frame_body = T_frame_w * T_w_body[i - in.first];
    for (const ScanReturn& beam : scans.returns(i)) {
      if (!beam.is_hit) continue;
      const Point2 p = T_frame_body * scans.point_body(beam);
      if (cells.is_first(p)) points.push_back(p);
    }
  }
  return points;
}

Submap CrossCheck::draw_recent() const {
  std::uint32_t first = index_of(query_);
  while (first > 0 && chain_.scan_of(static_cast<KeyframeId>(first - 1)) >= recent_.first) --first;
  BackendConfig config = config_;
  config.max_kernel_cells = kKernelCells;
  return build_submap(static_cast<KeyframeId>(first), query_, scans_, chain_, T_w_keyframe_, config);
}

bool CrossCheck::holds(const Submap& submap, const Pose2& T_submap_query) {
  if (!drawn_) drawn_ = draw_recent();
  const Pose2 T_drawn_query =
      between(T_w_keyframe_[index_of(drawn_->reference)], T_w_keyframe_[index_of(query_)]);
  const Pose2 T_drawn_w =
      T_drawn_query * T_submap_query.inverse() * T_w_keyframe_[index_of(submap.reference)].inverse();
  const ScanRange scans_of_submap{chain_.scan_of(submap.first), chain_.scan_of(submap.last)};
  std::size_t seen = 0;
  std::size_t on_walls = 0;
  const GridGeometry& grid = drawn_->geometry;
  for (const Point2& p : thinned_hits(scans_, chain_, scans_of_submap, T_w_keyframe_, T_drawn_w)) {
    const CellIndex cell = grid.cell(p);
    if (!grid.contains(cell)) continue;
    const std::uint8_t occupied = drawn_->cells[grid.offset(cell)];
    seen += occupied != 0 ? 1 : 0;
    on_walls += occupied >= kEven ? 1 : 0;
  }
  return seen >= kMinSeen && static_cast<double>(on_walls) >= kMinOnWalls * static_cast<double>(seen);
}

}  // namespace swiftlet
