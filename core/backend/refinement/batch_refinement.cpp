// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/refinement/wall_map.hpp"
#include "core/backend/store/traversal.hpp"

namespace swiftlet {
namespace {

constexpr double kWideRadiusM = 0.5;    // first steps: walls may lie this far apart ...
constexpr double kNarrowRadiusM = 0.3;  // ... then only what is close is the same wall
constexpr int kWideIterations = 5;
constexpr double kConvergedStep = 2e-4;  // metres or radians

struct PlacedReturn {
  PoseIndex pose{};
  std::uint32_t traversal = 0;
  bool held_out = false;
  Point2 p_body;
};

std::vector<PlacedReturn> hits_of(const ScanStore& scans) {
  std::vector<PlacedReturn> hits;
  std::uint32_t count = 0;
  const std::span<const StoredScan> stored = scans.all().values();
  for (std::size_t i = 0; i < stored.size(); ++i) {
    for (const ScanReturn& beam : scans.returns(stored[i])) {
      if (!beam.is_hit) continue;
      // 7 and 10 share no factor: every beam gives its share of held-out returns.
      hits.push_back({make_id<PoseIndex>(i), index_of(traversal_of(stored[i])),
                      (7 * count++) % kHoldOutEvery == 0, scans.point_body(beam)});
    }
  }
  return hits;
}

/// All that are not held back.
std::vector<TraversalPoint> in_map(const std::vector<PlacedReturn>& hits,
                                   const std::vector<Pose2>& T_map_body) {
  std::vector<TraversalPoint> points;
  points.reserve(hits.size());
  for (const PlacedReturn& hit : hits) {
    if (hit.held_out) continue;
    points.push_back({T_map_body[index_of(hit.pose)] * hit.p_body, hit.traversal});
  }
  return points;
}

/// What the held-out returns say of the poses: mean distance from the others' walls, capped; none nearby
/// counts full.
double held_out_error_m(const std::vector<PlacedReturn>& hits, const std::vector<Pose2>& T_map_body) {
  const WallMap walls(in_map(hits, T_map_body), kNarrowRadiusM);
  double sum = 0.0;
  std::size_t count = 0;
  for (const PlacedReturn& hit : hits) {
    if (!hit.held_out) continue;
    const TraversalPoint at{T_map_body[index_of(hit.pose)] * hit.p_body, hit.traversal};
    sum += judged_distance_m(walls.wall_near(at), at.p_map);
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// Dead reckoning from each scan to the next.
std::vector<RelativePoseFactor<PoseIndex>> motions_of(std::span<const StoredScan> scans,
                                                      const OdometryNoise& noise) {
  std::vector<RelativePoseFactor<PoseIndex>> motions;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    RelativePoseFactor<PoseIndex> c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    if (!scans[i].starts_segment || scans[i].odometry_ran_on)
      c.T_from_to = between(scans[i - 1].T_dead_body, scans[i].T_dead_body);
    c.information = motion_information(scans[i - 1], scans[i], noise) / noise.steps_err_together;
    motions.push_back(c);
  }
  return motions;
}

void add_walls(PoseSystem& system, const std::vector<PlacedReturn>& hits,
               const std::vector<Pose2>& T_map_body, double radius_m) {
  const WallMap walls(in_map(hits, T_map_body), radius_m);
  for (const PlacedReturn& hit : hits) {
    if (hit.held_out) continue;
    const TraversalPoint at{T_map_body[index_of(hit.pose)] * hit.p_body, hit.traversal};
    if (const auto wall = walls.wall_near(at)) {
      const PointToLineFactor pull = point_to_line_factor(*wall, T_map_body[index_of(hit.pose)], hit.p_body);
      system.add(hit.pose, pull.H, pull.rhs);
    }
  }
}

}  // namespace

Result<RefinementReport> refine_scan_poses(const ScanStore& scans, const SensorModel& sensor,
                                           std::span<const RelativePoseFactor<ScanId>> closures,
                                           std::span<const HeadingFactor<ScanId>> headings,
                                           const BackendConfig& config, std::vector<Pose2>& T_map_body) {
  SWIFTLET_CHECK(T_map_body.size() == scans.size(), "every scan has a pose");
  RefinementReport report;
  if (scans.size() < 2) return report;
  const std::vector<PlacedReturn> hits = hits_of(scans);
  const auto pose_of = [&](ScanId scan) { return make_id<PoseIndex>(scans.all().position(scan)); };
  std::vector<RelativePoseFactor<PoseIndex>> factors = motions_of(scans.all().values(), sensor.odometry);
  for (const RelativePoseFactor<ScanId>& c : closures)
    factors.push_back(c.joining(pose_of(c.from), pose_of(c.to)));
  PoseSystem system;
  if (Status status = system.prepare(scans.size(), factors); !status) return status.error();

  std::vector<Pose2> T = T_map_body;
  while (report.iterations < config.refinement_iterations) {
    const bool wide = report.iterations < kWideIterations;
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& f : factors) system.add(f, 1.0, T);
    for (const HeadingFactor<ScanId>& f : headings) system.add(f.of(pose_of(f.pose)), 1.0, T);
    add_walls(system, hits, T, wide ? kWideRadiusM : kNarrowRadiusM);
    const Result<double> largest = system.step(T);
    if (!largest) return largest.error();
    ++report.iterations;
    if (*largest < kConvergedStep && !wide) break;
  }
  report.held_out_before_m = held_out_error_m(hits, T_map_body);
  report.held_out_after_m = held_out_error_m(hits, T);
  report.accepted = report.held_out_after_m <= report.held_out_before_m;
  if (report.accepted) T_map_body = std::move(T);
  return report;
}

}  // namespace swiftlet
