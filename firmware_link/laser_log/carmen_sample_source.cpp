// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/carmen_sample_source.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/angle.hpp"
#include "firmware_link/laser_log/line_times.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kUsualBeamCount = 11;
// Scanners that meet nothing report their greatest range. Logs round readings to hundredths.
constexpr double kRoundingM = 0.01;
// Measured on the ACES log against its reference relations: the ranges fit the odometry of 0.1 s before.
constexpr Duration kAgeAgainstOdometryLines = std::chrono::milliseconds(100);
constexpr Duration kMaxUncovered = std::chrono::seconds(1);
constexpr Duration kLongestDisorder = std::chrono::seconds(5);
// Wheels that have moved do not come to stand at zero in all three numbers: their counters were reset.
constexpr double kMovedM = 0.3;
constexpr double kTurnedRad = radians(20.0);
constexpr std::uint8_t kScanStream = 0;
constexpr std::uint8_t kOdometryStream = 1;

/// Whether nearly all lines have a stamp of their own: some loggers write whole seconds, or one stamp for
/// all.
bool advances(std::span<const CarmenOdometry> lines) {
  std::size_t shared = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) shared += lines[i].stamp == lines[i - 1].stamp ? 1U : 0U;
  return shared <= lines.size() / 10;
}

/// Whether both ends and all but one in a hundred scans lie between ODOM lines that are near in time.
bool spans_scans(std::span<const CarmenOdometry> odometry, std::span<const CarmenOdometry> scans) {
  if (odometry.front().stamp > scans.front().stamp + kMaxUncovered ||
      odometry.back().stamp < scans.back().stamp - kMaxUncovered)
    return false;
  std::size_t uncovered = 0;
  std::size_t next = 1;
  for (const CarmenOdometry& scan : scans) {
    while (next + 1 < odometry.size() && odometry[next].stamp < scan.stamp) ++next;
    uncovered += odometry[next].stamp - odometry[next - 1].stamp > kMaxUncovered ? 1U : 0U;
  }
  return uncovered <= scans.size() / 100;
}

/// Whether the stamps of both can be trusted to place the scans among the ODOM lines, and these tell more
/// than the poses of the scans' own lines: between lines far apart the way is a straight one.
bool trusts_odometry_lines(const CarmenLog& log) {
  return 2 * log.odometry.size() >= log.scans.size() && log.odometry.size() >= 2 &&
         log.odometry_reversals == 0 && advances(log.odometry) && advances(log.scans) &&
         spans_scans(log.odometry, log.scans);
}

double path_m(std::span<const CarmenOdometry> scans, std::span<const std::size_t> order) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i)
    sum_m += distance_m(scans[order[i - 1]].position, scans[order[i]].position);
  return sum_m;
}

/// In which the scans were measured. Where a logger stamps lines late, or its clock is set back, their poses
/// lie on a shorter path in the order of the file than in that of the stamps.
std::vector<std::size_t> measured_order(const CarmenLog& log, bool uses_odometry_lines) {
  std::vector<std::size_t> by_stamp(log.scans.size());
  std::iota(by_stamp.begin(), by_stamp.end(), std::size_t{0});
  if (uses_odometry_lines || log.scan_reversals == 0) return by_stamp;
  std::vector<std::size_t> by_line = by_stamp;
  std::ranges::sort(by_line, {}, [&](std::size_t i) { return log.scans[i].line; });
  return path_m(log.scans, by_line) < path_m(log.scans, by_stamp) ? by_line : by_stamp;
}

/// Median of the times from one scan to the next; 0 for fewer than two.
Duration usual_interval(std::span<const DeviceTime> times) {
  std::vector<Duration> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  if (intervals.empty()) return Duration::zero();
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// `scan_times`: empty where dead reckoning comes from the ODOM lines.
Duration range_age(const CarmenLog& log, std::span<const DeviceTime> scan_times) {
  if (scan_times.empty()) return kAgeAgainstOdometryLines;
  return log.pose_scan_lag.runs_a_line_ahead() ? within_limits_of_range_age(usual_interval(scan_times))
                                               : Duration::zero();
}

SensorModel sensor_model(const CarmenLog& log, std::span<const DeviceTime> scan_times,
                         const SampleSourceOptions& options) {
  SensorModel sensor = SensorModel::carmen_laser();
  sensor.range_age = range_age(log, scan_times);
  if (options.range_age) sensor.range_age = *options.range_age;
  if (options.max_range_m) sensor.max_range_m = *options.max_range_m;
  if (log.max_range_m > 0.0) sensor.max_range_m = std::min(sensor.max_range_m, log.max_range_m - kRoundingM);
  if (options.min_range_m) sensor.min_range_m = *options.min_range_m;
  return sensor;
}

AssemblyConfig assembly_config(const CarmenLog& log, const SensorModel& sensor) {
  AssemblyConfig config;
  config.beams = log.beams;
  config.sensor = sensor;
  // Wheels count on while nothing is logged, and stamps of such logs come in bunches: only a jump breaks the
  // run.
  config.continuity.longest_interpolation = kLongestLineInterval;
  config.continuity.longest_silence = Duration::max();
  config.continuity.jump_slack_m = kWheelsJumpSlackM;
  config.continuity.top_turn_rate_rad_per_s = std::numeric_limits<double>::infinity();
  return config;
}

/// The log has one clock: its stamps are device time, too.
DeviceTime device_time(HostTime stamp) { return DeviceTime(stamp.time_since_epoch()); }

bool is_reset(const CarmenOdometry& before, const CarmenOdometry& now) {
  return now.is_zero && (distance_m(before.position, now.position) > kMovedM ||
                         std::abs(wrap_angle(before.yaw_rad)) > kTurnedRad);
}

std::string describe_odometry(const CarmenLog& log, bool uses_odometry_lines, Duration range_age) {
  if (uses_odometry_lines)
    return "dead reckoning from the ODOM lines, " +
           std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(range_age).count()) +
           " ms before each scan";
  const std::string choice = std::string("dead reckoning from the ") + log.scan_line + " lines: ";
  if (log.odometry.empty()) return choice + "there are no ODOM lines";
  if (log.odometry_reversals > 0)
    return choice + "the stamps of the ODOM lines go back " + std::to_string(log.odometry_reversals) +
           " times";
  if (!advances(log.odometry)) return choice + "many ODOM lines have the stamp of the line before";
  if (!advances(log.scans)) return choice + "many of them have the stamp of the line before";
  if (2 * log.odometry.size() < log.scans.size()) return choice + "there are few ODOM lines";
  return choice + "the ODOM lines do not span the scans";
}

std::string describe_lag(const PoseScanLag& lag, Duration range_age) {
  char turns[64];
  std::snprintf(turns, sizeof turns, "%.2f deg off on average, not %.2f",
                degrees(lag.difference_to_line_before_rad()), degrees(lag.difference_rad()));
  return "the scans turn with the poses of the line before (" + std::string(turns) + "): ranges taken for " +
         std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(range_age).count()) +
         " ms older than their poses";
}

}  // namespace

Result<std::unique_ptr<SampleSource>> CarmenSampleSource::open(const std::string& path,
                                                               const SampleSourceOptions& options) {
  const auto beam_count = static_cast<std::size_t>(options.beam_count.value_or(kUsualBeamCount));
  Result<CarmenLog> log = read_carmen_log(path, beam_count);
  if (!log) return log.error();
  if (!log->scans_have_poses && log->odometry.size() < 2)
    return Error{ErrorCode::kInvalidInput,
                 path + ": its RAWLASER1 lines have no poses, and there are no ODOM lines"};
  return std::unique_ptr<SampleSource>(
      new CarmenSampleSource(std::make_shared<const CarmenLog>(std::move(log).value()), options));
}

std::unique_ptr<SampleSource> CarmenSampleSource::again(std::optional<Duration> range_age) const {
  SampleSourceOptions options = options_;
  options.range_age = range_age;
  return std::unique_ptr<SampleSource>(new CarmenSampleSource(log_, options));
}

CarmenSampleSource::CarmenSampleSource(std::shared_ptr<const CarmenLog> log,
                                       const SampleSourceOptions& options)
    : log_(std::move(log)),
      options_(options),
      uses_odometry_lines_(!log_->scans_have_poses || trusts_odometry_lines(*log_)),
      scan_order_(measured_order(*log_, uses_odometry_lines_)),
      scan_times_(uses_odometry_lines_ ? std::vector<DeviceTime>() : regular_times(log_->scans)),
      sensor_(sensor_model(*log_, scan_times_, options)),
      assembler_(assembly_config(*log_, sensor_), report_.counters) {
  report_.counters.frames = log_->lines;
  report_.counters.duplicates = log_->duplicate_scans;
  report_.problems = log_->problems;
  report_.shows_age = uses_odometry_lines_;
  report_.notes.push_back(describe_odometry(*log_, uses_odometry_lines_, sensor_.range_age));
  if (!uses_odometry_lines_ && sensor_.range_age > Duration::zero() &&
      log_->pose_scan_lag.runs_a_line_ahead())
    report_.notes.push_back(describe_lag(log_->pose_scan_lag, sensor_.range_age));
  tell_of_stamps();
}

void CarmenSampleSource::tell_of_stamps() {
  if (log_->scan_reversals == 0) return;
  const std::string steps = std::to_string(log_->scan_reversals);
  if (!std::ranges::is_sorted(scan_order_)) {
    report_.notes.push_back("scans follow each other as in the file, not by their stamps (" + steps +
                            " steps back)");
    return;
  }
  report_.notes.push_back("scans out of time order were sorted (" + steps + " steps back)");
  if (log_->longest_step_back > kLongestDisorder)
    report_.problems.push_back(
        "the clock of the scans steps back by " +
        std::to_string(std::chrono::duration_cast<std::chrono::seconds>(log_->longest_step_back).count()) +
        " s: scans of different times are mixed; cut the log there");
}

Result<ReceivedSample> CarmenSampleSource::next() {
  for (;;) {
    if (const std::optional<RangeSample> sample = assembler_.take()) return ReceivedSample{.sample = *sample};
    if (feed()) continue;
    assembler_.end();
    if (const std::optional<RangeSample> sample = assembler_.take()) return ReceivedSample{.sample = *sample};
    finish_report();
    return Error{ErrorCode::kEndOfRecording, "end of the laser log"};
  }
}

void CarmenSampleSource::finish_report() {
  if (std::exchange(is_finished_, true)) return;
  const InputCounters& counters = report_.counters;
  if (counters.segments > 1)
    report_.notes.push_back("breaks in the dead reckoning: " + std::to_string(counters.segments - 1) +
                            "; a new segment begins behind each");
  if (counters.samples > 0 && counters.hits == 0) {
    char limits[48];
    std::snprintf(limits, sizeof limits, "%g to %g m", sensor_.min_range_m, sensor_.max_range_m);
    report_.notes.push_back("no range is a return (" + std::string(limits) +
                            "): there is no wall to draw and nothing to correct the dead reckoning by");
  }
}

bool CarmenSampleSource::feed() {
  const bool scans_left = next_scan_ < log_->scans.size();
  const bool odometry_left = uses_odometry_lines_ && next_odometry_ < log_->odometry.size();
  if (!scans_left && !odometry_left) return false;
  if (odometry_left &&
      (!scans_left || log_->odometry[next_odometry_].stamp <= log_->scans[next_scan_].stamp)) {
    feed_odometry(log_->odometry[next_odometry_++]);
  } else {
    feed_scan();
  }
  return true;
}

void CarmenSampleSource::feed_odometry(const CarmenOdometry& odometry) {
  Reading reading;
  reading.stream = kOdometryStream;
  reading.at = device_time(odometry.stamp);
  reading.received = odometry.stamp;
  add_pose(odometry, reading);
  assembler_.add(reading);
}

void CarmenSampleSource::add_pose(const CarmenOdometry& odometry, Reading& reading) {
  reading.position_odom = odometry.position;
  reading.yaw_odom_rad = wrap_angle(odometry.yaw_rad);
  reading.odometry_restarted = last_odometry_ && is_reset(*last_odometry_, odometry);
  last_odometry_ = odometry;
}

void CarmenSampleSource::feed_scan() {
  const CarmenOdometry& scan = log_->scans[scan_order_[next_scan_]];
  Reading reading;
  reading.stream = kScanStream;
  // Two different scans with one stamp are both used; the assembler requires ascending times.
  reading.at = uses_odometry_lines_ ? device_time(scan.stamp) : scan_times_[next_scan_];
  if (next_scan_ > 0) reading.at = std::max(reading.at, last_scan_at_ + Duration(1));
  last_scan_at_ = reading.at;
  reading.received = scan.stamp;
  if (!uses_odometry_lines_) add_pose(scan, reading);
  for (const float distance_m : log_->distances_of(scan_order_[next_scan_]))
    static_cast<void>(reading.distance_m.try_push_back(distance_m));
  ++next_scan_;
  assembler_.add(reading);
}

std::optional<double> CarmenSampleSource::progress() const {
  return static_cast<double>(next_scan_) / static_cast<double>(log_->scans.size());
}

}  // namespace swiftlet
