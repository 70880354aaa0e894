// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/flight_table_source.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "firmware_link/sample/attitude.hpp"
#include "firmware_link/sample/flight_assembly.hpp"
#include "firmware_link/sample_table/table_fields.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kMark = "# block,host_time_s,device_ms";
constexpr std::uint8_t kPositionRow = 1;
constexpr std::uint8_t kAttitudeRow = 2;
constexpr double kLatestS = 4e9;
constexpr double kLatestMs = 1e12;

/// The next fields of the row; nullopt: one is no number.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers(std::string_view& row) {
  std::array<double, kCount> values{};
  for (double& value : values) {
    const std::optional<double> number = parse_number<double>(next_field(row, ','));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    value = *number;
  }
  return values;
}

bool read_position(std::string_view row, Reading& reading) {
  const auto position = numbers<2>(row);
  if (position) reading.position_odom = Point2{(*position)[0], (*position)[1]};
  if (const auto height = numbers<1>(row)) reading.height_m = (*height)[0];
  return position.has_value();
}

bool read_attitude_and_ranges(std::string_view row, Reading& reading) {
  const auto q = numbers<4>(row);  // w, x, y, z
  const auto ranges = q ? numbers<4>(row) : std::nullopt;
  if (!ranges) return false;
  const Quaternion attitude{.x = (*q)[1], .y = (*q)[2], .z = (*q)[3], .w = (*q)[0]};
  reading.yaw_odom_rad = yaw_of(attitude);
  reading.tilt = tilt_of(attitude);
  const auto [front_m, back_m, left_m, right_m] = *ranges;
  for (const double distance_m : {front_m, left_m, back_m, right_m})
    static_cast<void>(reading.distance_m.try_push_back(static_cast<float>(distance_m)));
  return true;
}

/// nullopt: the row cannot be used.
std::optional<Reading> read_row(std::string_view row) {
  const auto head = numbers<3>(row);
  if (!head) return std::nullopt;
  const auto [block, host_time_s, device_ms] = *head;
  const bool is_possible =
      host_time_s >= 0.0 && host_time_s <= kLatestS && device_ms >= 0.0 && device_ms <= kLatestMs;
  if (!is_possible || (block != kPositionRow && block != kAttitudeRow)) return std::nullopt;
  Reading reading;
  reading.stream = static_cast<std::uint8_t>(block);
  reading.at = DeviceTime(std::chrono::milliseconds(std::llround(device_ms)));
  reading.received = HostTime(std::chrono::microseconds(std::llround(host_time_s * 1e6)));
  const bool is_read =
      block == kPositionRow ? read_position(row, reading) : read_attitude_and_ranges(row, reading);
  return is_read ? std::optional(reading) : std::nullopt;
}

}  // namespace

bool is_flight_table(const std::string& path) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return false;
  const Result<std::string_view> first = lines->next();
  return first && first->starts_with(kMark);
}

Result<std::unique_ptr<SampleSource>> FlightTableSource::open(const std::string& path,
                                                              const SampleSourceOptions& options) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return lines.error();
  SensorModel sensor = SensorModel::crazyflie();
  if (options.range_age) sensor.range_age = *options.range_age;
  if (options.max_range_m) sensor.max_range_m = *options.max_range_m;
  if (options.min_range_m) sensor.min_range_m = *options.min_range_m;
  std::unique_ptr<FlightTableSource> source(new FlightTableSource(path, std::move(lines).value(), sensor));
  if (options.beam_count) source->report_.notes.emplace_back(kBeamsIgnored);
  return std::unique_ptr<SampleSource>(std::move(source));
}

FlightTableSource::FlightTableSource(std::string path, GzipLines lines, const SensorModel& sensor)
    : path_(std::move(path)),
      lines_(std::move(lines)),
      sensor_(sensor),
      assembler_(flight_assembly(sensor), report_.counters) {
  assembler_.set_periods(Duration::zero(), Duration::zero());  // no row tells them
}

Result<ReceivedSample> FlightTableSource::next() {
  while (true) {
    if (const std::optional<RangeSample> sample = assembler_.take()) return ReceivedSample{.sample = *sample};
    if (has_ended_) return Error{ErrorCode::kEndOfRecording, "end of the table of log blocks"};
    feed();
  }
}

void FlightTableSource::feed() {
  const Result<std::string_view> row = lines_.next();
  if (!row) return end_with(row.error().code == ErrorCode::kDamaged ? row.error().message : "");
  if (row->empty()) return;
  ++report_.counters.frames;
  if (row->starts_with('#')) return;
  if (const std::optional<Reading> reading = read_row(*row)) return assembler_.add(ground_.hold(*reading));
  end_with(path_ + ", line " + std::to_string(lines_.line_number()) +
           ": is no row of a log block; the table is used up to there");
}

void FlightTableSource::end_with(const std::string& problem) {
  has_ended_ = true;
  assembler_.end();
  if (!problem.empty()) report_.problems.push_back(problem);
}

}  // namespace swiftlet
