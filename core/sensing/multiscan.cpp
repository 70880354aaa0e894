// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/multiscan.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

Point2 rotated(const Pose2& T_a_b, const Point2& direction_b) {
  return {T_a_b.cos_yaw() * direction_b.x_m - T_a_b.sin_yaw() * direction_b.y_m,
          T_a_b.sin_yaw() * direction_b.x_m + T_a_b.cos_yaw() * direction_b.y_m};
}

// The displacement of a point of the present frame, observed at or before j, by an error of T_j_next: the
// derivative of (v_x, v_y, w) with respect to (x, y, yaw) of T_j_next.
Eigen::Matrix3d displacement_jacobian(const Pose2& T_present_j, const Pose2& T_present_next) {
  Eigen::Matrix3d J;
  J << -T_present_j.cos_yaw(), T_present_j.sin_yaw(), -T_present_next.y_m(),  //
      -T_present_j.sin_yaw(), -T_present_j.cos_yaw(), T_present_next.x_m(),   //
      0.0, 0.0, -1.0;
  return J;
}

std::size_t scans_for(std::size_t points, std::size_t beams) {
  return std::clamp<std::size_t>((points + beams - 1) / beams, 2, kMaxMultiscanScans);
}

}  // namespace

Multiscan::Multiscan(const SensorModel& sensor, const BeamLayout& beams, std::size_t points,
                     const MultiscanTuning& tuning)
    : tuning_(tuning),
      scan_limit_(scans_for(points, std::max<std::size_t>(beams.count, 1))),
      min_range_m_(sensor.min_range_m),
      max_range_m_(sensor.max_range_m) {
  SWIFTLET_CHECK(scan_limit_ * beams.count <= kMaxMultiscanPoints, "the multiscan's points fit its view");
  for (std::size_t i = 0; i < beams.count; ++i)
    direction_[i] = {std::cos(beams.bearing_rad[i]), std::sin(beams.bearing_rad[i])};
}

void Multiscan::restart() {
  oldest_ = 0;
  size_ = 0;
}

bool Multiscan::is_short(const Pose2& motion) const {
  return std::hypot(motion.x_m(), motion.y_m()) < tuning_.min_motion_m &&
         std::abs(motion.yaw_rad()) < tuning_.min_turn_rad;
}

void Multiscan::add(const RangeSample& sample, const UncertainMotion& step) {
  UncertainMotion motion;
  bool replaces_newest = false;
  if (size_ > 0) {
    replaces_newest = size_ > 1 && is_short(scan(size_ - 1).motion.T_from_to);
    motion = replaces_newest ? scan(size_ - 1).motion * step : step;
  }
  if (!replaces_newest) push_empty_scan();
  Scan& newest = scan(size_ - 1);
  newest.motion = motion;
  newest.in_a_view = false;
  read_hits(sample, newest);
}

void Multiscan::push_empty_scan() {
  if (size_ == scan_limit_) {
    oldest_ = (oldest_ + 1) % kMaxMultiscanScans;
  } else {
    ++size_;
  }
}

void Multiscan::read_hits(const RangeSample& sample, Scan& scan) const {
  scan.hits.clear();
  for (std::size_t i = 0; i < sample.beam_count; ++i) {
    const double range_m = static_cast<double>(sample.distance_m[i]);
    if (sample.status[i] != RangeStatus::kHit || range_m < min_range_m_ || range_m > max_range_m_) continue;
    const Point2 p{range_m * direction_[i].x_m, range_m * direction_[i].y_m};
    const bool has_room = scan.hits.try_push_back({p, direction_[i], 0, static_cast<std::uint8_t>(i)});
    SWIFTLET_CHECK(has_room, "a sample has at most kMaxBeams beams");
  }
}

void Multiscan::assemble(MultiscanView& view) {
  view.points.clear();
  view.motion_covariance.clear();
  view.scans = size_;
  view.new_scans = 0;
  std::array<Pose2, kMaxMultiscanScans> T_present_scan;
  for (std::size_t i = size_; i-- > 1;)
    T_present_scan[i - 1] = T_present_scan[i] * scan(i).motion.T_from_to.inverse();
  for (std::size_t i = 0; i < size_; ++i) {
    Scan& from = scan(i);
    if (!from.in_a_view) ++view.new_scans;
    from.in_a_view = true;
    for (const MultiscanPoint& hit : from.hits) {
      const MultiscanPoint moved{T_present_scan[i] * hit.p_body, rotated(T_present_scan[i], hit.direction),
                                 static_cast<std::uint16_t>(i), hit.beam};
      const bool has_room = view.points.try_push_back(moved);
      SWIFTLET_CHECK(has_room, "the multiscan's points fit its view");
    }
    if (i + 1 == size_) break;
    const Eigen::Matrix3d J = displacement_jacobian(T_present_scan[i], T_present_scan[i + 1]);
    const bool has_room =
        view.motion_covariance.try_push_back(J * scan(i + 1).motion.covariance * J.transpose());
    SWIFTLET_CHECK(has_room, "the multiscan's motions fit its view");
  }
}

}  // namespace swiftlet
