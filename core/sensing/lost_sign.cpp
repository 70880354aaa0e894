// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/lost_sign.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

namespace swiftlet {
namespace {

constexpr double kAlikeM = 1e-6;
constexpr std::size_t kComparedAtOnce = 64;  // paths: bits of a view

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

/// The same in the frame of the odometry.
Point2 forward_step(const Pose2& T_odom_from, const Pose2& motion) {
  const double heading_rad = T_odom_from.yaw_rad() + motion.yaw_rad() / 2.0;
  return forward_m(motion) * Point2{std::cos(heading_rad), std::sin(heading_rad)};
}

}  // namespace

double prior_cost(std::span<const MendedOdometry> mended, const LostSignTuning& tuning) {
  double cost = 0.0;
  bool was_reversed = false;
  for (const MendedOdometry& m : mended)
    if (std::exchange(was_reversed, m.reversed) != m.reversed)
      cost += m.reversed ? tuning.begin_cost : tuning.end_cost;
  return cost;
}

LostSign::LostSign(const SensorModel& sensor, const BeamLayout& beams, const LostSignTuning& tuning)
    : tuning_(tuning),
      variance2_m2_(2.0 * tuning.sigma_m * tuning.sigma_m),
      max_range_m_(sensor.max_range_m),
      beam_step_(std::max<std::size_t>(1, (beams.count + kMaxRays - 1) / kMaxRays)),
      rays_(static_cast<Eigen::Index>((beams.count + beam_step_ - 1) / beam_step_)) {
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
  const Point2 forward = forward_step(newest_->T_odom_body, motion);
  for (Path& path : paths_)
    if (path.reversed) path.offset = path.offset - 2.0 * forward;
  const Scan& last = scans_.back();
  if (path_m_ - last.path_m >= tuning_.scan_spacing_m ||
      std::abs(wrap_angle(sample.T_odom_body.yaw_rad() - last.yaw_rad)) >= tuning_.scan_spacing_rad)
    judge(sample);
}

void LostSign::on_direction(double forward_m) {
  forward_m_ += forward_m;
  min_forward_m_ = std::min(min_forward_m_, forward_m_);
  max_forward_m_ = std::max(max_forward_m_, forward_m_);
  went_forward_ = went_forward_ || forward_m_ - min_forward_m_ > tuning_.both_ways_m;
  went_backward_ = went_backward_ || max_forward_m_ - forward_m_ > tuning_.both_ways_m;
  refuted_ = went_forward_ && went_backward_;
}

/// What was seen before does not lie in this frame, and how the vehicle will drive off is not known.
void LostSign::begin_segment(const RangeSample& sample) {
  scans_.clear();
  for_each_path([](Path& path) { path.scan_offsets.clear(); });
  speed_m_per_s_ = speed_before_m_per_s_ = 0.0;
  branch(added_ + 1);  // this sample has no step
  judge(sample);
}

/// Past the slowest sample of a standstill the sign may have changed.
void LostSign::on_speed(double speed_m_per_s) {
  const bool stood = speed_m_per_s_ < tuning_.standstill_m_per_s && speed_m_per_s_ < speed_before_m_per_s_ &&
                     speed_m_per_s_ <= speed_m_per_s;
  speed_before_m_per_s_ = std::exchange(speed_m_per_s_, speed_m_per_s);
  if (!stood || path_m_ - standstill_at_m_ < tuning_.standstill_spacing_m) return;
  standstill_at_m_ = path_m_;
  branch(added_);
}

void LostSign::branch(std::uint64_t sample) {
  const std::size_t count = paths_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Path other = paths_[i];
    other.reversed = !other.reversed;
    other.changes.push_back({sample, reported_.cost.contradiction - other.cost.contradiction});
    other.cost.misfit += other.reversed ? tuning_.begin_cost : tuning_.end_cost;
    other.changed_at_m = path_m_;
    paths_.push_back(std::move(other));
  }
}

void LostSign::judge(const RangeSample& sample) {
  while (!scans_.empty() && scans_.front().path_m < path_m_ - tuning_.memory_m) {
    scans_.pop_front();
    for_each_path([](Path& path) { path.scan_offsets.pop_front(); });
  }
  Scan scan = scan_of(sample);
  // Costs count by their differences: a path that is as reported within memory has none.
  if (paths_.size() > 1 || paths_.front().reversed || !is_settled(paths_.front())) add_costs(scan);
  for_each_path([](Path& path) { path.scan_offsets.push_back(path.offset); });
  scans_.push_back(std::move(scan));
  prune();
}

LostSign::Scan LostSign::scan_of(const RangeSample& sample) const {
  Scan scan{path_m_, sample.T_odom_body.yaw_rad(), sample.T_odom_body.position()};
  const Pose2 turned(0.0, 0.0, scan.yaw_rad);
  std::size_t i = 0;
  for (Eigen::Index ray = 0; ray < rays_; ++ray, i += beam_step_) {
    const RangeStatus status = sample.status[i];
    if (status == RangeStatus::kInvalid) continue;
    const double length_m = status == RangeStatus::kHit ? double{sample.distance_m[i]} : max_range_m_;
    const Point2 direction = turned * direction_[i];
    scan.status[ray] = status;
    scan.length_m[ray] = static_cast<float>(length_m);
    scan.direction.x[ray] = static_cast<float>(direction.x_m);
    scan.direction.y[ray] = static_cast<float>(direction.y_m);
    scan.reach_m[ray] = static_cast<float>(length_m - tuning_.before_m);
    if (status != RangeStatus::kHit) continue;
    scan.hit_m.x[ray] = static_cast<float>(length_m * direction.x_m);
    scan.hit_m.y[ray] = static_cast<float>(length_m * direction.y_m);
  }
  return scan;
}

void LostSign::add_costs(const Scan& scan) {
  std::vector<Path*> paths;
  for_each_path([&paths](Path& path) { paths.push_back(&path); });
  for (std::size_t begin = 0; begin < paths.size(); begin += kComparedAtOnce)
    add_costs(scan, std::span(paths).subspan(begin, std::min(kComparedAtOnce, paths.size() - begin)));
}

void LostSign::add_costs(const Scan& scan, std::span<Path* const> paths) const {
  const std::vector<View> views = views_of(scan, paths);
  std::vector<Encounter> met(paths.size());
  const double weight = std::min(1.0, tuning_.scan_weight / static_cast<double>(rays_));
  for (Eigen::Index ray = 0; ray < rays_; ++ray) {
    if (scan.status[ray] == RangeStatus::kInvalid) continue;
    const bool is_hit = scan.status[ray] == RangeStatus::kHit;
    const double jump = jump_cost(scan, ray);
    meet(scan, ray, views, met);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const double misfit = is_hit ? met[i].nearest2_m2 / variance2_m2_ : 0.0;
      paths[i]->cost.misfit += misfit;
      paths[i]->cost.contradiction +=
          weight * (met[i].contradicts ? tuning_.outlier_cost : std::min(misfit, jump));
    }
  }
}

/// Paths with the same signs since an earlier scan see it alike: it is met once for all of them.
std::vector<LostSign::View> LostSign::views_of(const Scan& scan, std::span<Path* const> paths) const {
  std::vector<View> views;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(views.size());
    for (std::size_t path = 0; path < paths.size(); ++path) {
      const Point2 from = scan.from + paths[path]->offset - paths[path]->scan_offsets[i] - scans_[i].from;
      auto same = std::find_if(views.begin() + first, views.end(),
                               [&](const View& v) { return length2(v.from - from) < kAlikeM * kAlikeM; });
      if (same == views.end()) same = views.insert(same, {&scans_[i], from, 0});
      same->paths |= std::uint64_t{1} << path;
    }
  }
  return views;
}

/// `met`: of each path.
void LostSign::meet(const Scan& scan, Eigen::Index ray, const std::vector<View>& views,
                    std::vector<Encounter>& met) const {
  std::fill(met.begin(), met.end(), Encounter{tuning_.outlier_cost * variance2_m2_, false});
  std::uint64_t contradicted = 0;
  for (const View& view : views) {
    const Encounter one = encounter(scan, ray, view, (view.paths & ~contradicted) != 0);
    if (one.contradicts) contradicted |= view.paths;
    for (std::uint64_t paths = view.paths; paths != 0; paths &= paths - 1) {
      double& nearest2_m2 = met[static_cast<std::size_t>(std::countr_zero(paths))].nearest2_m2;
      nearest2_m2 = std::min(nearest2_m2, one.nearest2_m2);
    }
  }
  for (std::size_t path = 0; path < met.size(); ++path)
    met[path].contradicts = (contradicted >> path & 1) != 0;
}

LostSign::Encounter LostSign::encounter(const Scan& scan, Eigen::Index ray, const View& view,
                                        bool is_open) const {
  const Scan& earlier = *view.earlier;
  const auto x_m = static_cast<float>(view.from.x_m);
  const auto y_m = static_cast<float>(view.from.y_m);
  const Planar<float> hit_m{x_m + scan.hit_m.x[ray], y_m + scan.hit_m.y[ray]};
  Encounter found;
  found.nearest2_m2 =
      ((earlier.hit_m.x - hit_m.x).square() + (earlier.hit_m.y - hit_m.y).square()).minCoeff();
  if (!is_open) return found;
  const Planar<float> direction{scan.direction.x[ray], scan.direction.y[ray]};
  const Planar<Lanes> earlier_hit_m{earlier.hit_m.x - x_m, earlier.hit_m.y - y_m};
  const Lanes here_m = outside(earlier.direction, earlier.reach_m, hit_m);
  const Lanes there_m = outside(direction, scan.reach_m[ray], earlier_hit_m);
  found.contradicts = here_m.min(there_m).minCoeff() < 0.0F;
  return found;
}

/// Rays pass through hits, as seen from the origin of the rays, where this is negative: one ray and many
/// hits, or many rays and one hit.
template <typename Rays, typename Hits>
LostSign::Lanes LostSign::outside(const Planar<Rays>& direction, const Rays& reach_m,
                                  const Planar<Hits>& hits) const {
  const Lanes along_m = hits.x * direction.x + hits.y * direction.y;
  const Lanes across_m = (hits.x * direction.y - hits.y * direction.x).abs();
  return (across_m - static_cast<float>(tuning_.beside_m)).max(-along_m).max(along_m - reach_m);
}

/// Ranges go on as they were or as they changed; in either case this carries no information on the signs.
double LostSign::jump_cost(const Scan& scan, Eigen::Index ray) const {
  const auto length_before = [&](std::size_t scans) -> std::optional<double> {
    if (scans_.size() < scans) return std::nullopt;
    const Scan& before = scans_[scans_.size() - scans];
    if (before.status[ray] != RangeStatus::kHit) return std::nullopt;
    return before.length_m[ray];
  };
  const std::optional<double> last_m = length_before(1);
  if (!last_m) return tuning_.outlier_cost;
  const double length_m = scan.length_m[ray];
  double jump_m = std::abs(length_m - *last_m);
  if (const std::optional<double> second_m = length_before(2))
    jump_m = std::min(jump_m, std::abs(length_m - 2.0 * *last_m + *second_m));
  return std::min(tuning_.outlier_cost, jump_m * jump_m / variance2_m2_);
}

bool LostSign::is_settled(const Path& path) const {
  return path.changes.empty() || path.changed_at_m < path_m_ - tuning_.memory_m;
}

/// Paths with the same signs within memory have the same future: the best of them is kept (Viterbi 1967).
/// Those that lag by more than a stretch can gain are not.
void LostSign::prune() {
  std::sort(paths_.begin(), paths_.end(),
            [](const Path& a, const Path& b) { return a.cost.misfit < b.cost.misfit; });
  const double min_misfit = paths_.front().cost.misfit;
  std::array<bool, 2> settled{};
  std::vector<Path> kept;
  for (Path& path : paths_) {
    if (kept.size() == tuning_.max_paths) break;
    if (path.cost.misfit > min_misfit + tuning_.max_gain) break;
    if (is_settled(path) && std::exchange(settled[path.reversed ? 1 : 0], true)) continue;
    kept.push_back(std::move(path));
  }
  paths_ = std::move(kept);
}

const LostSign::Path& LostSign::best() const {
  return *std::min_element(paths_.begin(), paths_.end(),
                           [](const Path& a, const Path& b) { return a.cost.misfit < b.cost.misfit; });
}

/// By how much less the path contradicts itself for the stretch that begins with this change.
double LostSign::gain(const Path& path, std::size_t begin) const {
  const bool is_last = begin + 2 >= path.changes.size();
  const double margin = is_last ? reported_.cost.contradiction - path.cost.contradiction
                                : path.changes[begin + 2].margin_before;
  return margin - path.changes[begin].margin_before;
}

double LostSign::evidence() const {
  const Path& path = best();
  double sum = 0.0;
  for (std::size_t begin = 0; begin < path.changes.size(); begin += 2)
    sum += std::min(gain(path, begin), tuning_.max_gain) - tuning_.stretch_doubt;
  return sum;
}

bool LostSign::are_lost() const {
  if (evidence() >= tuning_.min_evidence) return true;
  const Path& path = best();
  for (std::size_t begin = 0; begin < path.changes.size(); begin += 2)
    if (gain(path, begin) >= tuning_.clear_gain) return true;
  return false;
}

std::optional<RangeSample> LostSign::take() {
  if (held_.empty() || (!ended_ && !refuted_ && held_.size() <= tuning_.look_ahead)) return std::nullopt;
  RangeSample sample = held_.front();
  held_.pop_front();
  mend(sample, !sample.starts_segment && is_reversed(taken_));
  ++taken_;
  return sample;
}

/// A path is chosen as a whole: stretches on it may look reversed only because they lead to known ground.
bool LostSign::is_reversed(std::uint64_t sample) const {
  if (refuted_ || !are_lost()) return false;
  const Path& path = best();
  const auto after = std::upper_bound(path.changes.begin(), path.changes.end(), sample,
                                      [](std::uint64_t at, const Change& c) { return at < c.sample; });
  const auto before = static_cast<std::size_t>(after - path.changes.begin());
  return before % 2 == 1 && gain(path, before - 1) >= tuning_.stretch_doubt;
}

void LostSign::mend(RangeSample& sample, bool reversed) {
  const Pose2 T_odom_body = sample.T_odom_body;
  if (reversed) {
    const Pose2 motion = between(*T_odom_taken_, T_odom_body);
    offset_ = offset_ - 2.0 * forward_step(*T_odom_taken_, motion);
    reversed_m_ += length(motion.position());
  }
  if (reversed || (!mended_.empty() && mended_.back().reversed))
    mended_.push_back({sample.stamp, Pose2(offset_.x_m, offset_.y_m, 0.0), reversed});
  T_odom_taken_ = T_odom_body;
  if (mended_.empty()) return;
  const Point2 p = offset_ + T_odom_body.position();
  sample.T_odom_body = Pose2(p.x_m, p.y_m, T_odom_body.yaw_rad());
}

}  // namespace swiftlet
