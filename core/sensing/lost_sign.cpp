// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/lost_sign.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace swiftlet {
namespace {

Point2 operator+(const Point2& a, const Point2& b) { return {a.x_m + b.x_m, a.y_m + b.y_m}; }
Point2 operator-(const Point2& a, const Point2& b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
Point2 operator*(double s, const Point2& p) { return {s * p.x_m, s * p.y_m}; }
double length2(const Point2& p) { return p.x_m * p.x_m + p.y_m * p.y_m; }
double length(const Point2& p) { return std::hypot(p.x_m, p.y_m); }

/// Along the chord of an arc.
double forward_m(const Pose2& motion) {
  const double half_rad = motion.yaw_rad() / 2.0;
  return std::cos(half_rad) * motion.x_m() + std::sin(half_rad) * motion.y_m();
}

}  // namespace

Pose2 as_reported(std::span<const MendedPositions> mended, HostTime stamp, const Pose2& T_mended) {
  const auto after = std::upper_bound(mended.begin(), mended.end(), stamp,
                                      [](HostTime at, const MendedPositions& m) { return at < m.since; });
  if (after == mended.begin()) return T_mended;
  const MendedPositions& m = *std::prev(after);
  const Point2 p = m.sign * (T_mended.position() - m.offset);
  return {p.x_m, p.y_m, T_mended.yaw_rad()};
}

LostSign::LostSign(const SensorModel& sensor, const BeamLayout& beams, const LostSignTuning& tuning)
    : tuning_(tuning),
      max_range_m_(sensor.max_range_m),
      beam_step_((beams.count + tuning.max_beams - 1) / tuning.max_beams) {
  for (std::size_t i = 0; i < beams.count; ++i)
    direction_[i] = {std::cos(beams.bearing_rad[i]), std::sin(beams.bearing_rad[i])};
}

void LostSign::add(const RangeSample& sample) {
  if (!refuted_) follow(sample);
  newest_ = sample;
  held_.push_back(sample);
  ++added_;
}

void LostSign::follow(const RangeSample& sample) {
  if (!newest_ || sample.starts_segment) return begin_segment(sample);
  const Pose2 motion = between(newest_->T_odom_body, sample.T_odom_body);
  on_direction(forward_m(motion));
  if (refuted_) return;
  const Point2 step = sample.T_odom_body.position() - newest_->T_odom_body.position();
  const double duration_s = to_seconds(sample.measured_at - newest_->measured_at);
  if (duration_s > 0.0) on_speed(length(step) / duration_s);
  path_m_ += length(step);
  for (Path& path : paths_)
    if (path.reversed) path.offset = path.offset - 2.0 * step;
  const Scan& last = scans_.back();
  if (path_m_ - last.path_m >= tuning_.scan_spacing_m ||
      std::abs(wrap_angle(sample.T_odom_body.yaw_rad() - last.yaw_rad)) >= tuning_.scan_spacing_rad)
    judge(sample);
}

void LostSign::on_direction(double forward_m) {
  forward_m_ += forward_m;
  least_forward_m_ = std::min(least_forward_m_, forward_m_);
  most_forward_m_ = std::max(most_forward_m_, forward_m_);
  went_forward_ = went_forward_ || forward_m_ - least_forward_m_ > tuning_.both_ways_m;
  went_backward_ = went_backward_ || most_forward_m_ - forward_m_ > tuning_.both_ways_m;
  refuted_ = went_forward_ && went_backward_;
}

/// What was seen before does not lie in this frame.
void LostSign::begin_segment(const RangeSample& sample) {
  scans_.clear();
  reported_.scan_offsets.clear();
  for (Path& path : paths_) path.scan_offsets.clear();
  speed_m_per_s_ = speed_before_m_per_s_ = 0.0;
  judge(sample);
}

/// Past the slowest sample of a standstill the sign may have changed.
void LostSign::on_speed(double speed_m_per_s) {
  const bool stood = speed_m_per_s_ < tuning_.standstill_m_per_s && speed_m_per_s_ < speed_before_m_per_s_ &&
                     speed_m_per_s_ <= speed_m_per_s;
  speed_before_m_per_s_ = std::exchange(speed_m_per_s_, speed_m_per_s);
  if (!stood || path_m_ - standstill_at_m_ < tuning_.standstill_spacing_m) return;
  standstill_at_m_ = path_m_;
  branch();
}

void LostSign::branch() {
  const std::size_t count = paths_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Path other = paths_[i];
    other.reversed = !other.reversed;
    other.changes.push_back({added_, reported_.cost.contradiction - other.cost.contradiction});
    other.cost.misfit += other.reversed ? tuning_.begin_cost : tuning_.end_cost;
    other.changed_at_m = path_m_;
    paths_.push_back(std::move(other));
  }
}

void LostSign::judge(const RangeSample& sample) {
  while (!scans_.empty() && scans_.front().path_m < path_m_ - tuning_.memory_m) {
    scans_.pop_front();
    reported_.scan_offsets.pop_front();
    for (Path& path : paths_) path.scan_offsets.pop_front();
  }
  Scan scan = scan_of(sample);
  const auto take_into = [&](Path& path) {
    path.cost += cost_of(scan, path);
    path.scan_offsets.push_back(path.offset);
  };
  take_into(reported_);
  for (Path& path : paths_) take_into(path);
  scans_.push_back(std::move(scan));
  prune();
}

LostSign::Scan LostSign::scan_of(const RangeSample& sample) const {
  const Pose2& T_odom_body = sample.T_odom_body;
  Scan scan{path_m_, T_odom_body.yaw_rad(), {}};
  for (std::size_t i = 0; i < sample.beam_count; i += beam_step_) {
    const bool is_hit = sample.status[i] == RangeStatus::kHit;
    Ray ray;
    ray.status = sample.status[i];
    ray.length_m = is_hit ? double{sample.distance_m[i]} : max_range_m_;
    ray.from = T_odom_body.position();
    ray.end = T_odom_body * (ray.length_m * direction_[i]);
    ray.direction = (1.0 / ray.length_m) * (ray.end - ray.from);
    if (is_hit) ray.jump_cost = jump_cost(scan.rays.size(), ray.length_m);
    scan.rays.push_back(ray);
  }
  return scan;
}

/// Ranges go on as they were or as they changed; whatever the vehicle does, this says nothing on its signs.
double LostSign::jump_cost(std::size_t beam, double length_m) const {
  const auto length_before = [&](std::size_t scans) -> std::optional<double> {
    if (scans_.size() < scans) return std::nullopt;
    const Ray& ray = scans_[scans_.size() - scans].rays[beam];
    if (ray.status != RangeStatus::kHit) return std::nullopt;
    return ray.length_m;
  };
  const std::optional<double> last_m = length_before(1);
  if (!last_m) return tuning_.outlier_cost;
  double jump_m = std::abs(length_m - *last_m);
  if (const std::optional<double> second_m = length_before(2))
    jump_m = std::min(jump_m, std::abs(length_m - 2.0 * *last_m + *second_m));
  return std::min(tuning_.outlier_cost, jump_m * jump_m / (2.0 * tuning_.sigma_m * tuning_.sigma_m));
}

LostSign::Cost LostSign::cost_of(const Scan& scan, const Path& path) const {
  Cost sum;
  for (const Ray& ray : scan.rays)
    if (ray.status != RangeStatus::kInvalid) sum += cost_of(ray, path);
  if (!scan.rays.empty())
    sum.contradiction *= std::min(1.0, tuning_.scan_weight / static_cast<double>(scan.rays.size()));
  return sum;
}

LostSign::Cost LostSign::cost_of(const Ray& ray, const Path& path) const {
  const bool is_hit = ray.status == RangeStatus::kHit;
  const double variance2 = 2.0 * tuning_.sigma_m * tuning_.sigma_m;
  double nearest2 = tuning_.outlier_cost * variance2;
  bool contradicts = false;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Point2 moved = path.offset - path.scan_offsets[i];
    const Point2 end = ray.end + moved;
    for (const Ray& earlier : scans_[i].rays) {
      if (earlier.status == RangeStatus::kInvalid) continue;
      const bool was_hit = earlier.status == RangeStatus::kHit;
      if (is_hit && was_hit) nearest2 = std::min(nearest2, length2(end - earlier.end));
      if (contradicts) continue;
      contradicts =
          (is_hit && passes_through(earlier, end)) || (was_hit && passes_through(ray, earlier.end - moved));
    }
  }
  Cost cost;
  if (is_hit) cost.misfit = nearest2 / variance2;
  cost.contradiction = contradicts ? tuning_.outlier_cost : std::min(cost.misfit, ray.jump_cost);
  return cost;
}

bool LostSign::passes_through(const Ray& ray, const Point2& hit) const {
  const Point2 seen = hit - ray.from;
  const double along_m = seen.x_m * ray.direction.x_m + seen.y_m * ray.direction.y_m;
  const double across_m = seen.x_m * ray.direction.y_m - seen.y_m * ray.direction.x_m;
  return std::abs(across_m) < tuning_.beside_m && along_m > 0.0 && along_m < ray.length_m - tuning_.before_m;
}

/// Paths with the same signs within memory have the same future: the best of them is kept (Viterbi 1967).
void LostSign::prune() {
  std::sort(paths_.begin(), paths_.end(),
            [](const Path& a, const Path& b) { return a.cost.misfit < b.cost.misfit; });
  std::array<bool, 2> settled{};
  std::vector<Path> kept;
  for (Path& path : paths_) {
    if (kept.size() == tuning_.max_paths) break;
    const bool is_settled = path.changed_at_m < path_m_ - tuning_.memory_m || path.changes.empty();
    if (is_settled && std::exchange(settled[path.reversed ? 1 : 0], true)) continue;
    kept.push_back(std::move(path));
  }
  paths_ = std::move(kept);
}

const LostSign::Path& LostSign::best() const {
  return *std::min_element(paths_.begin(), paths_.end(),
                           [](const Path& a, const Path& b) { return a.cost.misfit < b.cost.misfit; });
}

double LostSign::evidence() const {
  const Path& path = best();
  double sum = 0.0;
  for (std::size_t begin = 0; begin < path.changes.size(); begin += 2) {
    const bool is_last = begin + 2 >= path.changes.size();
    const double lead = is_last ? reported_.cost.contradiction - path.cost.contradiction
                                : path.changes[begin + 2].lead_before;
    sum += std::min(lead - path.changes[begin].lead_before, tuning_.most_gain) - tuning_.stretch_doubt;
  }
  return sum;
}

std::optional<RangeSample> LostSign::take() {
  if (held_.empty() || (!ended_ && !refuted_ && held_.size() <= tuning_.look_ahead)) return std::nullopt;
  RangeSample sample = held_.front();
  held_.pop_front();
  mend(sample, !sample.starts_segment && is_reversed(taken_));
  ++taken_;
  return sample;
}

bool LostSign::is_reversed(std::uint64_t sample) const {
  if (refuted_ || evidence() < tuning_.least_evidence) return false;
  const std::vector<Change>& changes = best().changes;
  const auto after = std::upper_bound(changes.begin(), changes.end(), sample,
                                      [](std::uint64_t at, const Change& c) { return at < c.sample; });
  return (after - changes.begin()) % 2 == 1;
}

void LostSign::mend(RangeSample& sample, bool reversed) {
  const Pose2 T_odom_body = sample.T_odom_body;
  const double sign = reversed ? -1.0 : 1.0;
  if (sign != (mended_.empty() ? 1.0 : mended_.back().sign)) {
    // The step to this sample is the first with the other sign: positions are mirrored in the sample before.
    const Point2 before = T_odom_taken_->position();
    const Point2 before_mended =
        mended_.empty() ? before : mended_.back().offset + mended_.back().sign * before;
    mended_.push_back({sample.stamp, sign, before_mended - sign * before});
  }
  if (reversed) reversed_m_ += length(T_odom_body.position() - T_odom_taken_->position());
  T_odom_taken_ = T_odom_body;
  if (mended_.empty()) return;
  const Point2 p = mended_.back().offset + sign * T_odom_body.position();
  sample.T_odom_body = Pose2(p.x_m, p.y_m, T_odom_body.yaw_rad());
}

}  // namespace swiftlet
