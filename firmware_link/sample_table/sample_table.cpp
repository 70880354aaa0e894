// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/sample_table.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/sample_table/table_fields.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kSensorMark = "# sensor ";
constexpr std::string_view kBearingsMark = "# bearings_rad ";
constexpr std::string_view kStoreyMark = "# storey ";
constexpr std::string_view kWheels = "wheels";
constexpr std::string_view kFlow = "flow";
constexpr std::string_view kNoReturn = "inf";
constexpr std::string_view kInvalid = "nan";
constexpr double kMaxCoordinateM = 1e6;
constexpr std::int64_t kLatestNs = 4'000'000'000'000'000'000;  // the year 2096

/// With the fewest digits that give the same number back.
template <typename Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

Error cannot_be(std::string_view what, std::string_view text) {
  return {ErrorCode::kInvalidInput, std::string(what) + " cannot be '" + quoted(text) + "'"};
}

/// The value of `name=value`.
Result<double> named_value(std::string_view field, std::string_view name, double lowest, double highest) {
  const std::string start = std::string(name) + "=";
  if (!field.starts_with(start)) return cannot_be(name, field);
  const std::optional<double> value = parse_number<double>(field.substr(start.size()));
  if (!value || !(*value >= lowest && *value <= highest)) return cannot_be(name, field.substr(start.size()));
  return *value;
}

Result<SensorModel> parse_sensor(std::string_view line) {
  if (!line.starts_with(kSensorMark)) return cannot_be("the line of the sensor", line);
  line.remove_prefix(kSensorMark.size());
  const std::string_view odometry = next_field(line, ' ');
  if (odometry != kWheels && odometry != kFlow) return cannot_be("the dead reckoning", odometry);
  SensorModel sensor = odometry == kWheels ? SensorModel::carmen_laser() : SensorModel::crazyflie();
  const Result<double> min_m = named_value(next_field(line, ' '), "min_range_m", 0.0, kMaxCoordinateM);
  if (!min_m) return min_m.error();
  const Result<double> max_m = named_value(next_field(line, ' '), "max_range_m", *min_m, kMaxCoordinateM);
  if (!max_m) return max_m.error();
  const Result<double> age_s =
      named_value(next_field(line, ' '), "range_age_s", to_seconds(kMinRangeAge), to_seconds(kMaxRangeAge));
  if (!age_s) return age_s.error();
  if (!line.empty()) return cannot_be("what follows the range age", line);
  sensor.min_range_m = *min_m;
  sensor.max_range_m = *max_m;
  sensor.range_age = from_seconds(*age_s);
  return sensor;
}

Result<BeamLayout> parse_bearings(std::string_view line) {
  if (!line.starts_with(kBearingsMark)) return cannot_be("the line of the bearings", line);
  line.remove_prefix(kBearingsMark.size());
  BeamLayout beams;
  while (!line.empty()) {
    const std::string_view field = next_field(line, ',');
    const std::optional<double> bearing_rad = parse_number<double>(field);
    if (!bearing_rad || !(std::abs(*bearing_rad) <= 2.0 * kPi)) return cannot_be("a bearing", field);
    if (beams.count == kMaxBeams) return cannot_be("the number of beams", "more than 64");
    beams.bearing_rad[beams.count++] = *bearing_rad;
  }
  if (beams.count == 0) return cannot_be("the number of beams", "0");
  return beams;
}

Result<std::int64_t> parse_time(std::string_view& rest, std::string_view column) {
  const std::string_view field = next_field(rest, ',');
  const std::optional<std::int64_t> time_ns = parse_number<std::int64_t>(field);
  if (!time_ns || *time_ns < -kLatestNs || *time_ns > kLatestNs) return cannot_be(column, field);
  return *time_ns;
}

Result<Pose2> parse_pose(std::string_view& rest) {
  constexpr std::array<std::string_view, 3> kColumns{"odom_x_m", "odom_y_m", "odom_yaw_rad"};
  std::array<double, 3> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string_view field = next_field(rest, ',');
    const std::optional<double> part = parse_number<double>(field);
    if (!part || !(std::abs(*part) < kMaxCoordinateM)) return cannot_be(kColumns[i], field);
    parts[i] = *part;
  }
  return Pose2(parts[0], parts[1], parts[2]);
}

/// Of the range `text`, by the sensor's limits. False: it is none.
bool set_range(RangeSample& sample, std::size_t beam, std::string_view text, const SensorModel& sensor) {
  const std::optional<float> range_m = parse_number<float>(text);
  if (!range_m || *range_m < 0.0F) return false;
  sample.status[beam] =
      *range_m == 0.0F ? RangeStatus::kInvalid : classify_distance(static_cast<double>(*range_m), sensor);
  if (sample.status[beam] == RangeStatus::kHit) sample.distance_m[beam] = *range_m;
  return true;
}

}  // namespace

std::string sample_table_columns(std::size_t beam_count) {
  std::string text = "stamp_ns,measured_at_ns,odom_x_m,odom_y_m,odom_yaw_rad,segment";
  for (std::size_t i = 0; i < beam_count; ++i) text += ",range_" + std::to_string(i) + "_m";
  return text;
}

std::string sample_table_head(const SampleTableHead& head) {
  const SensorModel& sensor = head.sensor;
  const bool is_wheeled = sensor.odometry.drift_yaw_per_metre_rad > 0.0;
  std::string text(kSampleTableMark);
  text += '\n';
  text.append(kSensorMark).append(is_wheeled ? kWheels : kFlow).append(" min_range_m=");
  append_number(text, sensor.min_range_m);
  append_number(text += " max_range_m=", sensor.max_range_m);
  append_number(text += " range_age_s=", to_seconds(sensor.range_age));
  text.append("\n").append(kBearingsMark);
  for (std::size_t i = 0; i < head.beams.count; ++i)
    append_number(i == 0 ? text : text += ',', head.beams.bearing_rad[i]);
  return text + "\n" + sample_table_columns(head.beams.count) + "\n";
}

void append_sample_row(std::string& text, const RangeSample& sample, StoreyId& storey) {
  if (sample.storey != storey) {
    storey = sample.storey;
    append_number(text.append(kStoreyMark), index_of(storey));
    text += '\n';
  }
  append_number(text, std::int64_t{sample.stamp.time_since_epoch().count()});
  append_number(text += ',', std::int64_t{sample.measured_at.time_since_epoch().count()});
  append_number(text += ',', sample.T_odom_body.x_m());
  append_number(text += ',', sample.T_odom_body.y_m());
  append_number(text += ',', sample.T_odom_body.yaw_rad());
  append_number(text += ',', !sample.starts_segment ? 0 : sample.odometry_ran_on ? 2 : 1);
  for (std::size_t i = 0; i < sample.beam_count; ++i) {
    text += ',';
    if (sample.status[i] == RangeStatus::kHit)
      append_number(text, sample.distance_m[i]);
    else
      text += sample.status[i] == RangeStatus::kNoReturn ? kNoReturn : kInvalid;
  }
  text += '\n';
}

Result<SampleTableHead> parse_sample_table_head(std::string_view sensor, std::string_view bearings) {
  const Result<SensorModel> model = parse_sensor(sensor);
  if (!model) return model.error();
  const Result<BeamLayout> beams = parse_bearings(bearings);
  if (!beams) return beams.error();
  return SampleTableHead{.beams = *beams, .sensor = *model};
}

Result<std::optional<StoreyId>> parse_storey_line(std::string_view line) {
  if (!line.starts_with(kStoreyMark)) return std::optional<StoreyId>();
  line.remove_prefix(kStoreyMark.size());
  const std::optional<std::size_t> storey = parse_number<std::size_t>(line);
  if (!storey || *storey >= kMaxStoreys) return cannot_be("a storey", line);
  return std::optional(make_id<StoreyId>(*storey));
}

Result<RangeSample> parse_sample_row(std::string_view row, const SampleTableHead& head) {
  RangeSample sample;
  const Result<std::int64_t> stamp_ns = parse_time(row, "stamp_ns");
  if (!stamp_ns) return stamp_ns.error();
  const Result<std::int64_t> measured_at_ns = parse_time(row, "measured_at_ns");
  if (!measured_at_ns) return measured_at_ns.error();
  const Result<Pose2> T_odom_body = parse_pose(row);
  if (!T_odom_body) return T_odom_body.error();
  const std::string_view segment = next_field(row, ',');
  if (segment != "0" && segment != "1" && segment != "2") return cannot_be("segment", segment);
  sample.stamp = HostTime(Duration(*stamp_ns));
  sample.measured_at = DeviceTime(Duration(*measured_at_ns));
  sample.T_odom_body = *T_odom_body;
  sample.starts_segment = segment != "0";
  sample.odometry_ran_on = segment == "2";
  sample.beam_count = head.beams.count;
  for (std::size_t i = 0; i < head.beams.count; ++i) {
    const std::string_view field = next_field(row, ',');
    if (!set_range(sample, i, field, head.sensor))
      return cannot_be("range_" + std::to_string(i) + "_m", field);
  }
  if (!row.empty()) return cannot_be("what follows the last column", row);
  return sample;
}

}  // namespace swiftlet
