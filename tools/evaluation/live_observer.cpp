// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/live_observer.hpp"

#include <algorithm>
#include <cmath>

#include "tools/evaluation/nearest_wall.hpp"

namespace swiftlet {
namespace {

constexpr double kMovedM = 0.01;           // less is not noted
constexpr double kMovedRad = 0.005;        // likewise
constexpr std::size_t kScansOfWalls = 30;  // before and after a moment, whose returns draw the nearest wall
constexpr double kTravelOfWallsM = 1.0;    // likewise

/// The wall that is nearest to each scan, by the returns of the scans around it along the true path.
class WallsAlong {
 public:
  WallsAlong(const Backend& backend, const StampedPath& T_world_body) : scans_(&backend.scans()) {
    for (const auto& [id, scan] : scans_->all()) {
      const StampedPose* at = T_world_body.nearest(scan.stamp);
      T_world_scan_.push_back(at == nullptr ? std::nullopt : std::optional(at->pose));
    }
  }

  [[nodiscard]] std::optional<Point2> normal_at(ScanId id) const {
    if (!scans_->all().contains(id)) return std::nullopt;
    const std::size_t here = scans_->all().position(id);
    if (!T_world_scan_[here]) return std::nullopt;
    const std::span<const StoredScan> scans = scans_->all().values();
    std::vector<Point2> returns;
    const std::size_t end = std::min(scans.size(), here + kScansOfWalls + 1);
    for (std::size_t i = here - std::min(here, kScansOfWalls); i < end; ++i) {
      if (!T_world_scan_[i] || scans[i].storey != scans[here].storey) continue;
      if (std::abs(scans[i].path_m - scans[here].path_m) > kTravelOfWallsM) continue;
      for (const ScanReturn& beam : scans_->returns(scans[i]))
        if (beam.is_hit) returns.push_back(*T_world_scan_[i] * scans_->point_body(beam));
    }
    return nearest_wall_normal(returns, T_world_scan_[here]->position());
  }

 private:
  const ScanStore* scans_;
  std::vector<std::optional<Pose2>> T_world_scan_;  // by position
};

}  // namespace

void LiveObserver::look() {
  confidence_.look();
  const IdMap<ScanId, StoredScan>& scans = backend_->scans().all();
  if (scans.end_id() == seen_) return;
  seen_ = scans.end_id();
  const StoredScan& scan = scans.values().back();
  moments_.push_back({scan.stamp, scan.path_m, scan.T_map_live, scan.T_dead_body, scan.storey});
  const IdMap<KeyframeId, ScanId>& keyframes = backend_->keyframes().all();
  if (index_of(keyframes.end_id()) == histories_.size()) return;
  note_erased();
  histories_.resize(index_of(keyframes.end_id()));
  histories_.back().moment = static_cast<std::uint32_t>(moments_.size() - 1);
  for (std::size_t k = 0; k < keyframes.size(); ++k) follow(keyframes.id_at(k));
  held_ = keyframes.size();
}

void LiveObserver::note_erased() {
  const IdMap<KeyframeId, ScanId>& keyframes = backend_->keyframes().all();
  if (keyframes.size() == held_ + 1) return;
  for (std::size_t k = 0; k < histories_.size(); ++k)
    if (!histories_[k].erased && !keyframes.contains(make_id<KeyframeId>(k)))
      histories_[k].erased = static_cast<std::uint32_t>(moments_.size() - 1);
}

void LiveObserver::follow(KeyframeId keyframe) {
  const Pose2 T = backend_->T_map_keyframe(keyframe);
  std::vector<Published>& poses = histories_[index_of(keyframe)].poses;
  if (!poses.empty()) {
    const Pose2 moved = between(pose_of(poses.back()), T);
    if (std::hypot(moved.x_m(), moved.y_m()) < kMovedM && std::abs(moved.yaw_rad()) < kMovedRad) return;
  }
  poses.push_back({static_cast<std::uint32_t>(moments_.size() - 1), static_cast<float>(T.x_m()),
                   static_cast<float>(T.y_m()), static_cast<float>(T.yaw_rad())});
}

Pose2 LiveObserver::pose_of(const Published& p) {
  return {static_cast<double>(p.x_m), static_cast<double>(p.y_m), static_cast<double>(p.yaw_rad)};
}

std::vector<LiveMoment> LiveObserver::moments(const StampedPath& T_world_body) const {
  const WallsAlong walls(*backend_, T_world_body);
  std::vector<LiveMoment> moments;
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    const Moment& m = moments_[i];
    if (const StampedPose* truth = T_world_body.nearest(m.stamp))
      moments.push_back({m.stamp, m.path_m, m.T_map_body, m.T_local_body, truth->pose,
                         walls.normal_at(make_id<ScanId>(i)), m.storey});
  }
  return moments;
}

std::vector<PublishedKeyframe> LiveObserver::keyframes(const StampedPath& T_world_body) const {
  std::vector<PublishedKeyframe> keyframes;
  for (const History& history : histories_) {
    const Moment& made = moments_[history.moment];
    const StampedPose* truth = T_world_body.nearest(made.stamp);
    if (truth == nullptr) continue;
    PublishedKeyframe keyframe{made.path_m, {}, {}, truth->pose, made.storey};
    if (history.erased) keyframe.erased = moments_[*history.erased].stamp;
    for (const Published& p : history.poses)
      keyframe.T_map_body.push_back({moments_[p.moment].stamp, pose_of(p)});
    keyframes.push_back(std::move(keyframe));
  }
  return keyframes;
}

KnownPlaceError LiveObserver::error(const StampedPath& T_world_body) const {
  return known_place_error(moments(T_world_body), keyframes(T_world_body));
}

KnownPlaceError newest_pose_error(const Backend& finished, const StampedPath& T_world_body) {
  const ScanStore& scans = finished.scans();
  const ScanId newest = scans.all().last_id();
  const StampedPose* truth = T_world_body.nearest(scans[newest].stamp);
  if (truth == nullptr) return {};
  const std::vector<LiveMoment> moment{
      {scans[newest].stamp, scans[newest].path_m, finished.T_map_body(newest), Pose2(), truth->pose,
       WallsAlong(finished, T_world_body).normal_at(newest), scans[newest].storey}};
  std::vector<PublishedKeyframe> keyframes;
  for (const auto& [keyframe, scan] : finished.keyframes().all()) {
    const StampedPose* place = T_world_body.nearest(scans[scan].stamp);
    if (place == nullptr) continue;
    keyframes.push_back({scans[scan].path_m,
                         {{HostTime::min(), finished.T_map_keyframe(keyframe)}},
                         {},
                         place->pose,
                         scans[scan].storey});
  }
  return known_place_error(moment, keyframes);
}

}  // namespace swiftlet
