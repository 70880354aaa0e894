// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/submap.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/backend/loop_closing/max_filter.hpp"
#include "core/base/check.hpp"

namespace swiftlet {
namespace {

struct PlacedScan {
  const StoredScan* stored = nullptr;
  Pose2 T_submap_body;
};

double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }

void include(const Point2& p, Point2& low, Point2& high) {
  low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
  high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
}

/// Log-odds of occupancy by counting: the end of a beam is a hit, the cells before it are misses. A beam
/// without return adds nothing: at these ranges it is as often a bad surface as free space.
class EvidenceGrid {
 public:
  EvidenceGrid(const GridGeometry& geometry, const BackendConfig& config)
      : geometry_(geometry),
        hit_(static_cast<float>(log_odds(config.hit_probability))),
        miss_(static_cast<float>(log_odds(config.miss_probability))),
        max_evidence_(static_cast<float>(config.tuning.submap.max_evidence)),
        evidence_(geometry.cell_count(), 0.0F),
        known_(geometry.cell_count(), 0) {}

  void add(const ScanStore& scans, const PlacedScan& scan) {
    const Point2 start = geometry_.in_cells(scan.T_submap_body.position());
    for (const ScanReturn& beam : scans.returns(*scan.stored)) {
      if (!beam.is_hit) continue;
      const Point2 end = geometry_.in_cells(scan.T_submap_body * scans.point_body(beam));
      walk_ray(start, end, [&](CellIndex c) { mark(c, miss_); });
      mark(cell_of(end), hit_);
    }
  }
  [[nodiscard]] std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> out(evidence_.size(), 0);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (known_[i] == 0) continue;
      const double probability = 1.0 / (1.0 + std::exp(-static_cast<double>(evidence_[i])));
      out[i] = static_cast<std::uint8_t>(std::lround(255.0 * probability));
    }
    return out;
  }

 private:
  void mark(CellIndex c, float change) {
    if (!geometry_.contains(c)) return;
    const std::size_t i = geometry_.offset(c);
    evidence_[i] = std::clamp(evidence_[i] + change, -max_evidence_, max_evidence_);
    known_[i] = 1;
  }
  GridGeometry geometry_;
  float hit_;
  float miss_;
  float max_evidence_;
  std::vector<float> evidence_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

Submap build_submap(KeyframeId first, KeyframeId last, const ScanStore& scans, const KeyframeChain& chain,
                    const KeyframePoses& T_w_keyframe, const BackendConfig& config) {
  SWIFTLET_CHECK(first < last, "a submap has scans");
  const KeyframeId reference =
      chain.all().id_at((chain.all().position(first) + chain.all().position(last)) / 2);
  const Pose2 T_submap_w = T_w_keyframe[reference].inverse();
  std::vector<PlacedScan> placed;
  Point2 low{1e9, 1e9};
  Point2 high{-1e9, -1e9};
  const ScanRange drawn{chain.scan_of(first), chain.scan_of(last)};
  const std::vector<Pose2> T_w_body = chain.T_w_bodies(drawn, T_w_keyframe);
  const std::span<const StoredScan> stored = scans.all().values(drawn);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    placed.push_back({&stored[i], T_submap_w * T_w_body[i]});
    include(placed.back().T_submap_body.position(), low, high);
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (beam.is_hit) include(placed.back().T_submap_body * scans.point_body(beam), low, high);
    }
  }
  const double margin_m = 2.0 * config.grid_resolution_m;
  const GridGeometry geometry = GridGeometry::around(low, high, margin_m, config.grid_resolution_m);
  EvidenceGrid grid(geometry, config);
  for (const PlacedScan& scan : placed) grid.add(scans, scan);

  return Submap{.reference = reference,
                .scans = drawn,
                .storey = stored.front().storey,
                .end_path_m = chain.path_m(last),
                .geometry = geometry,
                .cells = max_kernel(geometry, grid.bytes(), config.max_kernel_cells),
                .low_m = low,
                .high_m = high};
}

}  // namespace swiftlet
