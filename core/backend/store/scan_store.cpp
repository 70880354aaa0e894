// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/scan_store.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

std::array<Point2, kMaxBeams> ScanStore::unit_directions(const BeamLayout& beams) {
  std::array<Point2, kMaxBeams> directions{};
  for (std::size_t i = 0; i < beams.count; ++i)
    directions[i] = {std::cos(beams.bearing_rad[i]), std::sin(beams.bearing_rad[i])};
  return directions;
}

ScanId ScanStore::add(const FrontendStep& step) {
  const RangeSample& sample = step.sample;
  StoredScan scan{.stamp = sample.stamp,
                  .measured_at = sample.measured_at,
                  .T_odom_body = sample.T_odom_body,
                  .T_dead_body = step.T_dead_body,
                  .T_keyframe_body = step.T_keyframe_body,
                  .T_map_live = step.T_map_body,
                  .keyframe = step.keyframe,
                  .path_m = 0.0,
                  .first_return = static_cast<std::uint32_t>(returns_.size()),
                  .return_count = 0,
                  .starts_segment = sample.starts_segment,
                  .odometry_ran_on = sample.odometry_ran_on,
                  .storey = sample.storey};
  if (!scans_.empty()) {
    const StoredScan& before = scans_.values().back();
    scan.path_m = before.path_m;
    if (!sample.starts_segment || sample.odometry_ran_on) {
      const Pose2 motion = between(before.T_odom_body, sample.T_odom_body);
      scan.path_m += std::hypot(motion.x_m(), motion.y_m());
    }
  }
  for (std::uint8_t beam = 0; beam < sample.beam_count; ++beam) {
    if (sample.status[beam] == RangeStatus::kInvalid) continue;
    returns_.push_back({sample.distance_m[beam], beam, sample.status[beam] == RangeStatus::kHit});
  }
  scan.return_count = static_cast<std::uint16_t>(returns_.size() - scan.first_return);
  seeing_ += scan.return_count > 0 ? 1 : 0;
  return scans_.push_back(scan);
}

std::size_t ScanStore::seeing(const ScanRange& range) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      scans_.values(range), [](const StoredScan& scan) { return scan.return_count > 0; }));
}

std::vector<RangeSample> ScanStore::samples() const {
  std::vector<RangeSample> samples;
  samples.reserve(size());
  for (const auto& [id, scan] : scans_) {
    RangeSample& sample = samples.emplace_back();
    sample.sequence = index_of(id);
    sample.measured_at = scan.measured_at;
    sample.stamp = scan.stamp;
    sample.T_odom_body = scan.T_odom_body;
    sample.starts_segment = scan.starts_segment;
    sample.odometry_ran_on = scan.odometry_ran_on;
    sample.storey = scan.storey;
    sample.beam_count = beams_.count;
    sample.status.fill(RangeStatus::kInvalid);
    for (const ScanReturn& beam : returns(scan)) {
      sample.status[beam.beam] = beam.is_hit ? RangeStatus::kHit : RangeStatus::kNoReturn;
      sample.distance_m[beam.beam] = beam.distance_m;
    }
  }
  return samples;
}

void ScanStore::erase(const IdRanges<ScanId>& pruned) {
  for (const ScanRange& hole : pruned) seeing_ -= seeing(hole);
  scans_.erase(pruned);
  for (const ScanRange& hole : pruned) {
    const ScanId behind = scans_.at_or_after(hole.end);
    if (behind == scans_.end_id()) continue;
    scans_[behind].starts_segment = true;
    scans_[behind].odometry_ran_on = false;
  }
  std::uint32_t kept = 0;
  for (StoredScan& scan : scans_.values()) {
    const auto first = returns_.begin() + scan.first_return;
    if (scan.first_return != kept) std::move(first, first + scan.return_count, returns_.begin() + kept);
    scan.first_return = kept;
    kept += scan.return_count;
  }
  returns_.resize(kept);
}

}  // namespace swiftlet
