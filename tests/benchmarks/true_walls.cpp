// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/benchmarks/true_walls.hpp"

#include <cstddef>
#include <optional>

#include "core/backend/refinement/wall_map.hpp"
#include "core/geometry/moments2.hpp"

namespace swiftlet {
namespace {

/// Farther from every wall, by the true pose, a return shows none of them.
constexpr double kMaxOffM = 0.15;

std::optional<std::uint32_t> wall_at(std::span<const WallSegment> walls, const Point2& p_world) {
  std::optional<std::uint32_t> nearest;
  double least_m = kMaxOffM;
  for (std::uint32_t k = 0; k < walls.size(); ++k) {
    const double off_m = distance_to_segment_m(p_world, walls[k].start, walls[k].end);
    if (off_m >= least_m) continue;
    least_m = off_m;
    nearest = k;
  }
  return nearest;
}

bool is_left_of(const WallSegment& wall, const Point2& p_world) {
  return (wall.end.x_m - wall.start.x_m) * (p_world.y_m - wall.start.y_m) >
         (wall.end.y_m - wall.start.y_m) * (p_world.x_m - wall.start.x_m);
}

Point2 left_normal(const WallSegment& wall) {
  const double length_m = distance_m(wall.start, wall.end);
  return {(wall.start.y_m - wall.end.y_m) / length_m, (wall.end.x_m - wall.start.x_m) / length_m};
}

double dot(const Point2& a, const Point2& b) { return a.x_m * b.x_m + a.y_m * b.y_m; }

Point2 opposite(const Point2& p) { return {-p.x_m, -p.y_m}; }

/// Of the returns on one face.
struct DrawnFace {
  Point2 first;
  Moments2 moments;  // relative to the first
};

WallPatch patch_of(const DrawnFace& face, const Point2& normal_world, const WallFitTuning& fit) {
  if (const std::optional<LocalWall> wall = wall_through(face.moments, face.first, fit))
    return {wall->center_map,
            dot(wall->normal_map, normal_world) < 0.0 ? opposite(wall->normal_map) : wall->normal_map};
  const Point2 mean = face.moments.scatter().mean;
  return {{face.first.x_m + mean.x_m, face.first.y_m + mean.y_m}, normal_world};
}

}  // namespace

TrueWalls::TrueWalls(std::span<const WallSegment> walls, std::span<const ScanHit> hits,
                     std::span<const Pose2> T_world_body) {
  for (const WallSegment& wall : walls) {
    normals_world_.push_back(opposite(left_normal(wall)));
    normals_world_.push_back(left_normal(wall));
  }
  for (const ScanHit& hit : hits) {
    const Pose2& T = T_world_body[hit.scan];
    const std::optional<std::uint32_t> wall = wall_at(walls, T * hit.p_body);
    face_of_.push_back(wall ? 2 * *wall + (is_left_of(walls[*wall], T.position()) ? 1U : 0U)
                            : WallPatches::kNone);
  }
}

WallPatches TrueWalls::drawn_by(std::span<const DrawnReturn> drawn, const WallFitTuning& fit) const {
  std::vector<DrawnFace> faces(normals_world_.size());
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    if (face_of_[k] == WallPatches::kNone) continue;
    DrawnFace& face = faces[face_of_[k]];
    const Point2& p = drawn[k].p_map;
    if (face.moments.count == 0) face.first = p;
    face.moments.add({p.x_m - face.first.x_m, p.y_m - face.first.y_m});
  }
  WallPatches found;
  std::vector<std::uint32_t> patch_of_face(faces.size(), WallPatches::kNone);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].moments.count == 0) continue;
    patch_of_face[f] = static_cast<std::uint32_t>(found.patches.size());
    found.patches.push_back(patch_of(faces[f], normals_world_[f], fit));
  }
  for (const std::uint32_t face : face_of_)
    found.patch_of.push_back(face == WallPatches::kNone ? face : patch_of_face[face]);
  return found;
}

}  // namespace swiftlet
