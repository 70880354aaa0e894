// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/scan_store.hpp"

#include <cmath>

namespace swiftlet {

std::array<Point2, kMaxBeams> ScanStore::unit_directions(const BeamLayout& beams) {
  std::array<Point2, kMaxBeams> directions{};
  for (std::size_t i = 0; i < beams.count; ++i)
    directions[i] = {std::cos(beams.bearing_rad[i]), std::sin(beams.bearing_rad[i])};
  return directions;
}

ScanIndex ScanStore::add(const FrontendStep& step) {
  const RangeSample& sample = step.sample;
  StoredScan scan{.stamp = sample.stamp,
                  .number = next_number_++,
                  .T_odom_body = sample.T_odom_body,
                  .T_dead_body = step.T_dead_body,
                  .T_keyframe_body = step.T_keyframe_body,
                  .T_map_live = step.T_map_body,
                  .keyframe = static_cast<KeyframeId>(index_of(step.keyframe) - keyframes_removed_),
                  .path_m = 0.0,
                  .first_return = static_cast<std::uint32_t>(returns_.size()),
                  .return_count = 0,
                  .starts_segment = sample.starts_segment,
                  .odometry_ran_on = sample.odometry_ran_on};
  if (!scans_.empty()) {
    scan.path_m = scans_.back().path_m;
    if (!sample.starts_segment || sample.odometry_ran_on) {
      const Pose2 motion = between(scans_.back().T_odom_body, sample.T_odom_body);
      scan.path_m += std::hypot(motion.x_m(), motion.y_m());
    }
  }
  for (std::uint8_t beam = 0; beam < sample.beam_count; ++beam) {
    if (sample.status[beam] == RangeStatus::kInvalid) continue;
    returns_.push_back({sample.distance_m[beam], beam, sample.status[beam] == RangeStatus::kHit});
  }
  scan.return_count = static_cast<std::uint16_t>(returns_.size() - scan.first_return);
  scans_.push_back(scan);
  return static_cast<ScanIndex>(scans_.size() - 1);
}

void ScanStore::remove(const IndexRemoval& scans, const IndexRemoval& keyframes) {
  IndexRemoval returns;
  for (const ScanRange& hole : scans.ranges()) {
    const std::uint32_t first = scans_[hole.first].first_return;
    returns.add({first, first + static_cast<std::uint32_t>(return_count(hole))});
    if (hole.end == scans_.size()) continue;
    scans_[hole.end].starts_segment = true;
    scans_[hole.end].odometry_ran_on = false;
  }
  scans.apply(scans_);
  for (StoredScan& scan : scans_) {
    scan.first_return = returns.new_index(scan.first_return);
    scan.keyframe = static_cast<KeyframeId>(keyframes.new_index(index_of(scan.keyframe)));
  }
  returns.apply(returns_);
  keyframes_removed_ += keyframes.size();
}

}  // namespace swiftlet
