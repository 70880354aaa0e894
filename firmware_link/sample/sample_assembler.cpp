// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/sample_assembler.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/check.hpp"
#include "firmware_link/sample/level_range.hpp"
#include "firmware_link/session/vehicle_monitor.hpp"

namespace swiftlet {
namespace {

constexpr Duration kReboot = std::chrono::seconds(1);
constexpr double kGapInPeriods = 1.5;
// Packets that hold height and altitude may be a period apart, and one may be lost.
constexpr Duration kHeightHolds = std::chrono::milliseconds(300);
// The ranges that follow one lost packet keep their dead reckoning.
constexpr double kMaxInterpolationInPeriods = 2.5;
// Readings farther apart are no dead reckoning.
constexpr Duration kLongestLearnt = std::chrono::seconds(1);

Duration scaled(Duration duration, double factor) { return from_seconds(to_seconds(duration) * factor); }

}  // namespace

RangeStatus classify_distance(double distance_m, const SensorModel& sensor) {
  if (!(distance_m >= sensor.min_range_m)) return RangeStatus::kInvalid;
  return distance_m >= sensor.max_range_m ? RangeStatus::kNoReturn : RangeStatus::kHit;
}

SampleAssembler::SampleAssembler(const AssemblyConfig& config, InputCounters& counters)
    : config_(config),
      counters_(counters),
      attitude_(config.continuity),
      positions_(config.continuity),
      yaws_(config.continuity),
      tilts_(config.continuity),
      heights_(config.continuity) {}

void SampleAssembler::set_periods(Duration range_period, Duration odometry_period) {
  config_.range_period = range_period;
  learns_range_period_ = range_period == Duration::zero();
  learns_odometry_period_ = odometry_period == Duration::zero();
  if (learns_range_period_) range_times_ = {};
  if (learns_odometry_period_) position_times_ = yaw_times_ = {};
  interpolate_across(odometry_period);
}

/// What is faster than usual, or not known (0), counts as usual.
void SampleAssembler::interpolate_across(Duration odometry_period) {
  config_.continuity.longest_interpolation =
      scaled(std::max(odometry_period, kUsualPeriod), kMaxInterpolationInPeriods);
  positions_.set_limits(config_.continuity);
  yaws_.set_limits(config_.continuity);
  interpolate_attitude();
}

/// Across the periods of the slower of dead reckoning and ranges.
void SampleAssembler::interpolate_attitude() {
  attitude_.longest_interpolation = std::max(config_.continuity.longest_interpolation,
                                             scaled(config_.range_period, kMaxInterpolationInPeriods));
  tilts_.set_limits(attitude_);
  heights_.set_limits(attitude_);
}

void SampleAssembler::learn_periods(const Reading& reading) {
  if (!reading.distance_m.empty()) range_times_.add(reading.at);
  if (reading.position_odom) position_times_.add(reading.at);
  if (reading.yaw_odom_rad) yaw_times_.add(reading.at);
  apply_learnt_periods();
}

void SampleAssembler::apply_learnt_periods() {
  if (learns_range_period_ && (range_times_.is_certain() || ended_)) {
    learns_range_period_ = false;
    config_.range_period = range_times_.period();
    interpolate_attitude();
    for (const Duration between_ranges : range_times_.spacings()) count_hole(between_ranges);
  }
  const bool is_certain = position_times_.is_certain() && yaw_times_.is_certain();
  const bool is_likely = !position_times_.spacings().empty() && !yaw_times_.spacings().empty();
  if (learns_odometry_period_ && (is_certain || (is_likely && pending_.full()) || ended_)) {
    learns_odometry_period_ = false;
    const Duration slower = std::max(position_times_.period(), yaw_times_.period());
    interpolate_across(std::min(slower, kLongestLearnt));
  }
}

void SampleAssembler::end() {
  ended_ = true;
  apply_learnt_periods();
}

void SampleAssembler::add(const Reading& reading) {
  SWIFTLET_CHECK(reading.distance_m.empty() || reading.distance_m.size() == config_.beams.count,
                 "a reading has a distance for each beam of the layout, or none");
  if (!accept_time(reading)) return;
  latest_ = std::max(latest_, reading.at);
  if (reading.odometry_restarted) {
    positions_.restart();
    yaws_.restart();
  }
  if (reading.position_odom || reading.yaw_odom_rad) ++counters_.odometry_packets;
  bool leaps = false;
  if (reading.position_odom && std::isfinite(reading.position_odom->x_m) &&
      std::isfinite(reading.position_odom->y_m))
    leaps = positions_.add(reading.at, *reading.position_odom);
  if (reading.yaw_odom_rad && std::isfinite(*reading.yaw_odom_rad))
    leaps = yaws_.add(reading.at, {*reading.yaw_odom_rad}) || leaps;
  if (leaps) ++counters_.leaps;
  if (reading.tilt && reading.tilt->is_possible()) static_cast<void>(tilts_.add(reading.at, *reading.tilt));
  if (reading.height_m && std::isfinite(*reading.height_m))
    static_cast<void>(heights_.add(reading.at, {*reading.height_m}));
  follow_ground(reading);
  if (!reading.distance_m.empty()) hold_ranges(reading);
  if (learns_range_period_ || learns_odometry_period_) learn_periods(reading);
}

/// A height that is no number, or none above 0: the ground is out of reach, or nothing measures it.
void SampleAssembler::follow_ground(const Reading& reading) {
  if (reading.height_m) {
    last_height_.reset();
    if (std::isfinite(*reading.height_m) && *reading.height_m > 0.0)
      last_height_ = {reading.at, *reading.height_m};
  }
  if (!last_height_ || reading.at - last_height_->at > kHeightHolds) return;
  if (reading.altitude_m && std::isfinite(*reading.altitude_m))
    storeys_.add(reading.at, *reading.altitude_m - last_height_->height_m);
}

bool SampleAssembler::accept_time(const Reading& reading) {
  if (reading.boot != boot_) {
    boot_ = reading.boot;
    restart();
    latest_ = reading.at;
  }
  std::optional<DeviceTime>& last = last_by_stream_[reading.stream];
  if (last && reading.at == *last) {
    ++counters_.duplicates;
    return false;
  }
  if (last && reading.at < *last && *last - reading.at <= kReboot) {
    ++counters_.out_of_order;
    return false;
  }
  if (latest_ - reading.at > kReboot) {
    restart();
    latest_ = reading.at;
  }
  last = reading.at;
  return true;
}

void SampleAssembler::restart() {
  while (!pending_.empty()) drop_oldest();
  last_by_stream_.fill(std::nullopt);
  last_ranges_at_.reset();
  last_measurement_.reset();
  positions_.restart();
  yaws_.restart();
  tilts_.restart();
  heights_.restart();
  last_height_.reset();
  low_at_odom_.reset();
  travelled_low_ = false;
  storeys_.restart();
}

void SampleAssembler::hold_ranges(const Reading& reading) {
  // Ranges may move to another block: then packets may overtake each other.
  if (last_ranges_at_ && reading.at <= *last_ranges_at_) {
    ++counters_.out_of_order;
    return;
  }
  ++counters_.range_packets;
  count_gap(reading);
  if (repeats_measurement(reading)) {
    ++counters_.repeated;
    return;
  }
  if (pending_.full()) drop_oldest();
  static_cast<void>(
      pending_.try_push_back({reading.at - config_.sensor.range_age, reading.received, reading.distance_m}));
}

/// By the vehicle's clock; by the host's if the vehicle's has restarted.
void SampleAssembler::count_gap(const Reading& reading) {
  if (last_ranges_received_ && config_.range_period > Duration::zero())
    count_hole(last_ranges_at_ ? reading.at - *last_ranges_at_ : reading.received - *last_ranges_received_);
  last_ranges_at_ = reading.at;
  last_ranges_received_ = reading.received;
}

void SampleAssembler::count_hole(Duration between_ranges) {
  const double periods = to_seconds(between_ranges) / to_seconds(config_.range_period);
  if (periods <= kGapInPeriods) return;
  ++counters_.gaps;
  counters_.missing_packets += static_cast<std::uint64_t>(std::lround(periods)) - 1;
}

bool SampleAssembler::repeats_measurement(const Reading& reading) {
  const auto is_same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  if (last_measurement_ && reading.at - last_measurement_->first_at < config_.measurement_period &&
      std::ranges::equal(reading.distance_m, last_measurement_->distance_m, is_same))
    return true;
  last_measurement_ = {reading.at, reading.distance_m};
  return false;
}

std::optional<RangeSample> SampleAssembler::take() {
  using Outcome = OdometryTimeline<Point2>::Outcome;
  using YawOutcome = OdometryTimeline<YawReading>::Outcome;
  while (!pending_.empty()) {
    const DeviceTime at = pending_.front().measured_at;
    const auto position = positions_.at(at);
    const auto yaw = yaws_.at(at);
    const bool too_early = position.outcome == Outcome::kTooEarly || yaw.outcome == YawOutcome::kTooEarly;
    const bool never = position.outcome == Outcome::kNever || yaw.outcome == YawOutcome::kNever;
    const bool in_hole = position.outcome == Outcome::kHole || yaw.outcome == YawOutcome::kHole;
    if ((too_early || in_hole) && !never && learns_odometry_period_) return std::nullopt;
    // A reading later than one interpolation span could not be used; another span for packets that overtake
    // each other.
    const auto may_come = [&](const ContinuityLimits& limits) {
      return !ended_ && latest_ - at <= 2 * limits.longest_interpolation;
    };
    const bool is_incomplete =
        (too_early && may_come(config_.continuity)) ||
        (!too_early && (is_coming(tilts_, at) || is_coming(heights_, at)) && may_come(attitude_));
    if (is_incomplete && !never && !in_hole) return std::nullopt;
    if (too_early || never || in_hole) {
      drop_oldest();
      continue;
    }
    const Pose2 T_odom_body(position.value.x_m, position.value.y_m, yaw.value.yaw_rad);
    const Motion motion{position.run, yaw.run, position.pauses + yaw.pauses, at};
    if (!is_within_reach(position.value, motion)) {
      ++counters_.too_far;
      pending_.erase(0);
      continue;
    }
    const RangeSample sample = finish(pending_.front(), T_odom_body, motion);
    pending_.erase(0);
    return sample;
  }
  return std::nullopt;
}

template <typename Timeline>
bool SampleAssembler::is_coming(const Timeline& timeline, DeviceTime at) const {
  return timeline.at(at).outcome == Timeline::Outcome::kTooEarly && timeline.goes_on(latest_);
}

bool SampleAssembler::is_of_last_run(const Motion& motion) const {
  return last_motion_ && last_motion_->position_run == motion.position_run &&
         last_motion_->yaw_run == motion.yaw_run;
}

/// Across a pause that is not interpolated, samples are as far apart as the readings around it.
bool SampleAssembler::was_watched_until(const Motion& motion) const {
  return motion.pauses == last_motion_->pauses ||
         motion.at - last_motion_->at < config_.continuity.unwatched_after;
}

bool SampleAssembler::is_within_reach(const Point2& position_odom, const Motion& motion) {
  if (!is_of_last_run(motion)) began_at_odom_ = position_odom;
  return distance_m(began_at_odom_, position_odom) <= config_.continuity.farthest_m;
}

RangeSample SampleAssembler::finish(const PendingRanges& ranges, const Pose2& T_odom_body,
                                    const Motion& motion) {
  RangeSample sample;
  sample.sequence = next_sequence_++;
  sample.measured_at = ranges.measured_at;
  sample.stamp = ranges.received;
  sample.T_odom_body = T_odom_body;
  const bool runs_on = is_of_last_run(motion);
  const bool was_watched = runs_on && was_watched_until(motion);
  sample.starts_segment = !was_watched;
  sample.odometry_ran_on = runs_on && !was_watched;
  last_motion_ = motion;
  sample.storey = storeys_.current();
  sample.beam_count = config_.beams.count;
  fill_beams(ranges, sample);
  ++counters_.samples;
  if (sample.starts_segment) ++counters_.segments;
  return sample;
}

/// What travels on the floor does not stand there: nothing measures its height.
bool SampleAssembler::stands_at(double height_m, const Point2& position_odom) {
  if (height_m > kStandingM) {
    low_at_odom_.reset();
    travelled_low_ = false;
    return false;
  }
  if (!low_at_odom_) low_at_odom_ = position_odom;
  travelled_low_ = travelled_low_ || distance_m(*low_at_odom_, position_odom) > kCarriedM;
  return !travelled_low_;
}

void SampleAssembler::fill_beams(const PendingRanges& ranges, RangeSample& sample) {
  const auto tilt = tilts_.at(ranges.measured_at);
  const auto height = heights_.at(ranges.measured_at);
  const bool knows_tilt = tilt.outcome == OdometryTimeline<BodyTilt>::Outcome::kFound;
  const bool has_height = height.outcome == OdometryTimeline<HeightReading>::Outcome::kFound;
  const bool stands = has_height && stands_at(height.value.height_m, sample.T_odom_body.position());
  const bool knows_height = has_height && !travelled_low_;
  for (std::size_t i = 0; i < ranges.distance_m.size(); ++i) {
    const auto range_m = static_cast<double>(ranges.distance_m[i]);
    const double rise = knows_tilt ? rise_of_beam(config_.beams.bearing_rad[i], tilt.value) : 0.0;
    const double level_m = level_range_m(range_m, rise);
    RangeStatus status = stands ? RangeStatus::kInvalid : classify_distance(range_m, config_.sensor);
    if (status == RangeStatus::kHit)
      status = classify_distance(level_m, config_.sensor);  // of a body on its side
    const bool is_floor = status == RangeStatus::kHit && knows_tilt && knows_height &&
                          can_be_floor(range_m, rise, height.value.height_m);
    if (is_floor) {
      status = RangeStatus::kInvalid;
      ++counters_.floor_returns;
    }
    sample.status[i] = status;
    if (status == RangeStatus::kHit) sample.distance_m[i] = static_cast<float>(level_m);
    if (status == RangeStatus::kHit) ++counters_.hits;
    if (status == RangeStatus::kNoReturn) ++counters_.no_returns;
    if (status == RangeStatus::kInvalid) ++counters_.invalid;
  }
}

void SampleAssembler::drop_oldest() {
  ++counters_.unpaired;
  pending_.erase(0);
}

}  // namespace swiftlet
