// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/known_place_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

/// The greatest of the lowest share of the values.
double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double rms(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// A keyframe of old ground: where it is, and where the map had it.
struct OldPlace {
  Pose2 T_world_body;
  Pose2 T_map_body;
};

/// Nothing where it had not been published.
std::optional<Pose2> published(const PublishedKeyframe& keyframe, HostTime stamp) {
  const auto behind = std::lower_bound(keyframe.T_map_body.begin(), keyframe.T_map_body.end(), stamp,
                                       [](const StampedPose& at, HostTime t) { return at.stamp < t; });
  if (behind == keyframe.T_map_body.begin()) return std::nullopt;
  return (behind - 1)->pose;
}

/// Mean of the poses in the map and in the world, turned and moved onto each other.
Pose2 alignment(std::span<const OldPlace> places) {
  Point2 in_map;
  Point2 in_world;
  double sin_sum = 0.0;
  double cos_sum = 0.0;
  for (const OldPlace& place : places) {
    in_map.x_m += place.T_map_body.x_m();
    in_map.y_m += place.T_map_body.y_m();
    in_world.x_m += place.T_world_body.x_m();
    in_world.y_m += place.T_world_body.y_m();
    const double turn_rad = place.T_world_body.yaw_rad() - place.T_map_body.yaw_rad();
    sin_sum += std::sin(turn_rad);
    cos_sum += std::cos(turn_rad);
  }
  const auto count = static_cast<double>(places.size());
  const Pose2 turn(0.0, 0.0, std::atan2(sin_sum, cos_sum));
  const Point2 turned = turn * Point2{in_map.x_m / count, in_map.y_m / count};
  return {in_world.x_m / count - turned.x_m, in_world.y_m / count - turned.y_m, turn.yaw_rad()};
}

/// From one contact with old ground that begins off until the pose is settled.
class WayBack {
 public:
  explicit WayBack(const KnownPlaceTuning& tuning) : tuning_(tuning) {}

  void add(const LiveMoment& moment, double error_m) {
    if (moment.path_m - last_known_path_m_ > tuning_.contact_gap_m) {
      ++contacts_;
      if (!off_since_ && error_m > tuning_.settled_m) off_since_ = moment.stamp;
    }
    last_known_path_m_ = moment.path_m;
    if (off_since_ && error_m <= tuning_.settled_m) end(moment.stamp);
  }
  void end(HostTime stamp) {
    if (off_since_) took_s_.push_back(to_seconds(stamp - *off_since_));
    off_since_.reset();
  }
  void write(KnownPlaceError& error) const {
    error.contacts = contacts_;
    error.contacts_off = took_s_.size();
    error.settled_s = took_s_;
    if (!took_s_.empty()) error.settled_p50_s = quantile(took_s_, 0.5);
  }

 private:
  KnownPlaceTuning tuning_;
  double last_known_path_m_ = -std::numeric_limits<double>::infinity();
  std::optional<HostTime> off_since_;
  std::size_t contacts_ = 0;
  std::vector<double> took_s_;
};

class Evaluator {
 public:
  Evaluator(std::span<const PublishedKeyframe> keyframes, const KnownPlaceTuning& tuning)
      : tuning_(tuning), keyframes_(keyframes), way_back_(tuning) {}

  void add(const LiveMoment& moment) {
    take_old(moment);
    near_.clear();
    for (std::vector<OldPlace>& ring : rings_) ring.clear();
    for (const PublishedKeyframe* keyframe : old_)
      if (keyframe->storey == moment.storey) sort(*keyframe, moment);
    if (!near_.empty()) judge_pose(moment);
    for (std::size_t i = 0; i < rings_.size(); ++i) judge_map(moment, rings_[i], map_errors_m_[i]);
  }

  void add_step(const LiveMoment& from, const LiveMoment& to) {
    const Pose2 T_map_expected = from.T_map_body * between(from.T_local_body, to.T_local_body);
    const double jump_m = distance_m(T_map_expected.position(), to.T_map_body.position());
    jumps_ += jump_m > tuning_.off_m ? 1U : 0U;
    greatest_jump_m_ = std::max(greatest_jump_m_, jump_m);
  }

  KnownPlaceError finish(HostTime end) {
    KnownPlaceError error;
    way_back_.end(end);
    way_back_.write(error);
    error.jumps = jumps_;
    error.greatest_jump_m = greatest_jump_m_;
    error.moments = errors_m_.size();
    for (std::size_t i = 0; i < map_errors_m_.size(); ++i)
      if (!map_errors_m_[i].empty()) error.map_rms_m[i] = rms(map_errors_m_[i]);
    if (errors_m_.empty()) return error;
    error.errors = std::move(errors_);
    error.rms_m = rms(errors_m_);
    error.p95_m = quantile(errors_m_, 0.95);
    error.max_m = *std::max_element(errors_m_.begin(), errors_m_.end());
    const auto off =
        std::count_if(errors_m_.begin(), errors_m_.end(), [&](double e) { return e > tuning_.off_m; });
    error.share_off = static_cast<double>(off) / static_cast<double>(errors_m_.size());
    if (!across_m_.empty()) error.across_p95_m = quantile(across_m_, 0.95);
    if (!along_m_.empty()) error.along_p95_m = quantile(along_m_, 0.95);
    error.across_m = std::move(across_m_);
    error.along_m = std::move(along_m_);
    return error;
  }

 private:
  /// The keyframes that are old by now and have not been erased.
  void take_old(const LiveMoment& moment) {
    while (next_ < keyframes_.size() && keyframes_[next_].path_m <= moment.path_m - tuning_.old_after_m)
      old_.push_back(&keyframes_[next_++]);
    std::erase_if(old_, [&](const PublishedKeyframe* k) { return k->erased && *k->erased < moment.stamp; });
  }

  void sort(const PublishedKeyframe& keyframe, const LiveMoment& moment) {
    const double away_m = distance_m(keyframe.T_world_body.position(), moment.T_world_body.position());
    const bool is_near = away_m <= tuning_.near_m;
    std::optional<Pose2> T_map_body;
    if (is_near) T_map_body = published(keyframe, moment.stamp);
    if (T_map_body) near_.push_back({keyframe.T_world_body, *T_map_body});
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (std::abs(away_m - tuning_.distances_m[i]) > tuning_.ring_m) continue;
      if (!T_map_body) T_map_body = published(keyframe, moment.stamp);
      if (T_map_body) rings_[i].push_back({keyframe.T_world_body, *T_map_body});
    }
  }

  void judge_pose(const LiveMoment& moment) {
    const Point2 seen = alignment(near_) * moment.T_map_body.position();
    const Point2 off{seen.x_m - moment.T_world_body.x_m(), seen.y_m - moment.T_world_body.y_m()};
    const double error_m = std::hypot(off.x_m, off.y_m);
    errors_m_.push_back(error_m);
    errors_.push_back({moment.stamp, error_m});
    way_back_.add(moment, error_m);
    if (!moment.wall_normal_world) return;
    const Point2& normal = *moment.wall_normal_world;
    across_m_.push_back(std::abs(normal.x_m * off.x_m + normal.y_m * off.y_m));
    along_m_.push_back(std::abs(normal.x_m * off.y_m - normal.y_m * off.x_m));
  }

  void judge_map(const LiveMoment& moment, std::span<const OldPlace> ring, std::vector<double>& errors_m) {
    if (ring.empty()) return;
    double sum_m2 = 0.0;
    for (const OldPlace& place : ring) {
      const Point2 as_published = between(moment.T_map_body, place.T_map_body).position();
      const Point2 in_truth = between(moment.T_world_body, place.T_world_body).position();
      const double error_m = distance_m(as_published, in_truth);
      sum_m2 += error_m * error_m;
    }
    errors_m.push_back(std::sqrt(sum_m2 / static_cast<double>(ring.size())));
  }

  KnownPlaceTuning tuning_;
  std::span<const PublishedKeyframe> keyframes_;
  std::size_t next_ = 0;                       // keyframes before this one were old at some time
  std::vector<const PublishedKeyframe*> old_;  // at this moment, of those
  WayBack way_back_;
  std::vector<OldPlace> near_;                  // at this moment
  std::array<std::vector<OldPlace>, 3> rings_;  // likewise
  std::vector<double> errors_m_;                // of moments
  std::vector<StampedError> errors_;
  std::vector<double> across_m_;
  std::vector<double> along_m_;
  std::array<std::vector<double>, 3> map_errors_m_;
  std::size_t jumps_ = 0;
  double greatest_jump_m_ = 0.0;
};

}  // namespace

KnownPlaceError known_place_error(std::span<const LiveMoment> moments,
                                  std::span<const PublishedKeyframe> keyframes,
                                  const KnownPlaceTuning& tuning) {
  if (moments.empty()) return {};
  Evaluator evaluator(keyframes, tuning);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    evaluator.add(moments[i]);
    if (i > 0) evaluator.add_step(moments[i - 1], moments[i]);
  }
  return evaluator.finish(moments.back().stamp);
}

}  // namespace swiftlet
