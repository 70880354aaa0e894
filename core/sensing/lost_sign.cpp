// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/lost_sign.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

LostSign::LostSign(const BeamLayout& beams, const LostSignTuning& tuning) : tuning_(tuning), beams_(beams) {
  beam_step_ = (beams.count + tuning.max_beams - 1) / tuning.max_beams;
  paths_.emplace_back();
  paths_.emplace_back();
}

const LostSign::Path& LostSign::best() const {
  return *std::min_element(paths_.begin() + 1, paths_.end(),
                           [](const Path& a, const Path& b) { return a.cost < b.cost; });
}
double LostSign::evidence() const { return paths_[0].cost - best().cost; }

void LostSign::add(const RangeSample& sample) {
  if (!refuted_) step(sample);
  last_ = sample;
  held_.push_back(sample);
  ++next_;
}

void LostSign::step(const RangeSample& sample) {
  if (!last_ || sample.starts_segment) {
    scans_.clear();
    for (Path& p : paths_) p.offsets.clear();
    speed_before_ = speed_ = 0;
    score(sample);
    return;
  }
  const Pose2 m = between(last_->T_odom_body, sample.T_odom_body);
  const double half = m.yaw_rad() / 2;
  if (m.x_m() * std::cos(half) + m.y_m() * std::sin(half) < -tuning_.backward_step_m) {
    refuted_ = true;
    return;
  }
  const double dt = to_seconds(sample.measured_at - last_->measured_at);
  const double way = std::hypot(m.x_m(), m.y_m());
  const double speed = way / std::max(dt, 1e-3);
  if (speed_ < tuning_.standstill_m_per_s && speed_ < speed_before_ && speed_ <= speed &&
      path_m_ - dip_at_m_ >= tuning_.dip_travel_m) {
    dip_at_m_ = path_m_;
    branch();
  }
  speed_before_ = speed_;
  speed_ = speed;
  path_m_ += way;
  const Point2 d{sample.T_odom_body.x_m() - last_->T_odom_body.x_m(),
                 sample.T_odom_body.y_m() - last_->T_odom_body.y_m()};
  for (Path& p : paths_)
    if (p.reversed) p.offset = {p.offset.x_m - 2 * d.x_m, p.offset.y_m - 2 * d.y_m};
  const Scan& before = scans_.back();
  const Pose2 since = between(before.T, sample.T_odom_body);
  if (path_m_ - before.path_m >= tuning_.scan_spacing_m ||
      std::abs(since.yaw_rad()) >= tuning_.scan_spacing_rad) {
    score(sample);
    prune();
  }
}

void LostSign::branch() {
  const std::size_t n = paths_.size();
  for (std::size_t i = 1; i < n; ++i) {
    Path other = paths_[i];
    other.reversed = !other.reversed;
    other.cost += other.reversed ? tuning_.to_reverse : tuning_.to_forward;
    other.switched_at_m = path_m_;
    other.switches.push_back(next_);
    paths_.push_back(std::move(other));
  }
}

void LostSign::score(const RangeSample& sample) {
  Scan scan{path_m_, sample.T_odom_body, {}};
  for (std::size_t b = 0; b < sample.beam_count; b += beam_step_) {
    if (sample.status[b] != RangeStatus::kHit) continue;
    const double r = sample.distance_m[b];
    scan.hits.push_back(sample.T_odom_body *
                        Point2{r * std::cos(beams_.bearing_rad[b]), r * std::sin(beams_.bearing_rad[b])});
  }
  while (!scans_.empty() && scans_.front().path_m < path_m_ - tuning_.memory_m) {
    scans_.pop_front();
    for (Path& p : paths_) p.offsets.pop_front();
  }
  const double cap2 = tuning_.cap * 2 * tuning_.sigma_m * tuning_.sigma_m;
  for (Path& p : paths_) {
    double sum = 0;
    for (const Point2& h : scan.hits) {
      double nearest = cap2;
      for (std::size_t j = 0; j < scans_.size(); ++j) {
        const double x = h.x_m + p.offset.x_m - p.offsets[j].x_m;
        const double y = h.y_m + p.offset.y_m - p.offsets[j].y_m;
        for (const Point2& g : scans_[j].hits)
          nearest = std::min(nearest, (x - g.x_m) * (x - g.x_m) + (y - g.y_m) * (y - g.y_m));
      }
      sum += nearest / (2 * tuning_.sigma_m * tuning_.sigma_m);
    }
    p.cost += tuning_.weight * sum;
    p.offsets.push_back(p.offset);
  }
  scans_.push_back(std::move(scan));
}

void LostSign::prune() {
  std::sort(paths_.begin() + 1, paths_.end(), [](const Path& a, const Path& b) { return a.cost < b.cost; });
  std::vector<Path> kept;
  kept.push_back(std::move(paths_[0]));
  for (std::size_t i = 1; i < paths_.size() && kept.size() <= tuning_.max_paths; ++i) {
    Path& p = paths_[i];
    const bool settled = p.switched_at_m < path_m_ - tuning_.memory_m;
    const bool known = settled && std::any_of(kept.begin() + 1, kept.end(), [&](const Path& k) {
                         return k.reversed == p.reversed && k.switched_at_m < path_m_ - tuning_.memory_m;
                       });
    if (!known) kept.push_back(std::move(p));
  }
  paths_ = std::move(kept);
}

void LostSign::end() { ended_ = true; }

std::optional<RangeSample> LostSign::take() {
  if (held_.empty() || (!ended_ && !refuted_ && held_.size() <= tuning_.look_ahead)) return std::nullopt;
  RangeSample s = held_.front();
  held_.pop_front();
  RangeSample out = mend(s);
  ++first_held_;
  return out;
}

RangeSample LostSign::mend(RangeSample s) {
  const Path& b = best();
  bool reversed = false;
  if (!refuted_ && evidence() > tuning_.evidence) {
    const auto n = std::upper_bound(b.switches.begin(), b.switches.end(), first_held_) - b.switches.begin();
    reversed = n % 2 == 1;
  }
  const Pose2 T = s.T_odom_body;
  if (reversed && T_out_before_ && !s.starts_segment) {
    const Point2 d{T.x_m() - T_out_before_->x_m(), T.y_m() - T_out_before_->y_m()};
    out_offset_ = {out_offset_.x_m - 2 * d.x_m, out_offset_.y_m - 2 * d.y_m};
    report_.reversed_m += std::hypot(d.x_m, d.y_m);
    if (!out_reversed_) ++report_.stretches;
  }
  out_reversed_ = reversed;
  T_out_before_ = T;
  if (out_offset_.x_m != 0 || out_offset_.y_m != 0)
    s.T_odom_body = Pose2(T.x_m() + out_offset_.x_m, T.y_m() + out_offset_.y_m, T.yaw_rad());
  return s;
}

}  // namespace swiftlet
