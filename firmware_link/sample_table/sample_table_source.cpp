// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/sample_table_source.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "firmware_link/sample/odometry_timeline.hpp"

namespace swiftlet {
namespace {

/// The limits of both.
SensorModel narrowed(SensorModel sensor, const SampleSourceOptions& options) {
  sensor.min_range_m = std::max(sensor.min_range_m, options.min_range_m.value_or(0.0));
  sensor.max_range_m = std::min(sensor.max_range_m, options.max_range_m.value_or(sensor.max_range_m));
  return sensor;
}

Result<SampleTableHead> read_head(GzipLines& lines) {
  std::array<std::string, 4> head;
  for (std::string& line : head) {
    const Result<std::string_view> next = lines.next();
    if (!next) return Error{ErrorCode::kInvalidInput, "it ends within its head"};
    line = *next;
    if (head[0] != kSampleTableMark)
      return Error{ErrorCode::kInvalidInput, "its first line is not '" + std::string(kSampleTableMark) + "'"};
  }
  Result<SampleTableHead> parsed = parse_sample_table_head(head[1], head[2]);
  if (parsed && head[3] != sample_table_columns(parsed->beams.count))
    return Error{ErrorCode::kInvalidInput,
                 "its columns are not " + sample_table_columns(parsed->beams.count)};
  return parsed;
}

}  // namespace

bool is_taken_for_sample_table(const std::string& path) {
  if (path.ends_with(".csv") || path.ends_with(".csv.gz")) return true;
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return false;
  const Result<std::string_view> first = lines->next();
  return first && *first == kSampleTableMark;
}

SampleTableSource::SampleTableSource(std::string path, GzipLines lines, const SampleTableHead& head)
    : path_(std::move(path)), lines_(std::move(lines)), head_(head) {
  report_.shows_age = false;
}

Result<std::unique_ptr<SampleSource>> SampleTableSource::open(const std::string& path,
                                                              const SampleSourceOptions& options) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return lines.error();
  Result<SampleTableHead> head = read_head(*lines);
  if (!head)
    return Error{ErrorCode::kInvalidInput, path + " is no table of samples: " + head.error().message +
                                               "; swiftlet convert writes such tables"};
  head->sensor = narrowed(head->sensor, options);
  if (head->sensor.min_range_m >= head->sensor.max_range_m)
    return Error{ErrorCode::kInvalidInput, path + ": no range lies between the limits set and its own"};
  std::unique_ptr<SampleTableSource> source(new SampleTableSource(path, std::move(lines).value(), *head));
  if (options.beam_count) source->report_.notes.emplace_back(kBeamsIgnored);
  return std::unique_ptr<SampleSource>(std::move(source));
}

Error SampleTableSource::end_with(const std::string& problem) {
  has_ended_ = true;
  if (!problem.empty()) report_.problems.push_back(problem);
  return {ErrorCode::kEndOfRecording, "end of the table of samples"};
}

void SampleTableSource::count(const RangeSample& sample) {
  InputCounters& counters = report_.counters;
  ++counters.frames;
  ++counters.samples;
  if (sample.starts_segment) ++counters.segments;
  for (std::size_t i = 0; i < sample.beam_count; ++i) {
    const RangeStatus status = sample.status[i];
    ++(status == RangeStatus::kHit        ? counters.hits
       : status == RangeStatus::kNoReturn ? counters.no_returns
                                          : counters.invalid);
  }
}

/// Farther than any source of samples lets through, whether it flies or has wheels.
bool SampleTableSource::leaps(const RangeSample& sample) const {
  if (!last_ || (sample.starts_segment && !sample.odometry_ran_on)) return false;
  const double passed_s = to_seconds(sample.measured_at - last_->measured_at);
  return distance_m(last_->T_odom_body.position(), sample.T_odom_body.position()) >
         kWheelsJumpSlackM + ContinuityLimits().top_speed_m_per_s * std::max(passed_s, 0.0);
}

Error SampleTableSource::end_at_line(const std::string& problem) {
  return end_with(path_ + ", line " + std::to_string(lines_.line_number()) + ": " + problem +
                  "; the table is used up to there");
}

/// The next one of a sample.
Result<std::string_view> SampleTableSource::next_row() {
  for (;;) {
    Result<std::string_view> line = lines_.next();
    if (!line) return end_with(line.error().code == ErrorCode::kEndOfRecording ? "" : line.error().message);
    if (line->empty()) continue;
    const Result<std::optional<StoreyId>> storey = parse_storey_line(*line);
    if (!storey) return end_at_line(storey.error().message);
    if (!*storey) return line;
    storey_ = **storey;
  }
}

Result<ReceivedSample> SampleTableSource::next() {
  if (has_ended_) return end_with("");
  const Result<std::string_view> row = next_row();
  if (!row) return row.error();
  Result<RangeSample> sample = parse_sample_row(*row, head_);
  if (!sample) return end_at_line(sample.error().message);
  if (!last_) sample->starts_segment = true;
  const bool goes_on = !sample->starts_segment || sample->odometry_ran_on;
  if (last_ && goes_on && sample->measured_at <= last_->measured_at)
    return end_at_line("measured_at_ns does not increase");
  if (leaps(*sample)) {
    sample->starts_segment = true;
    sample->odometry_ran_on = false;
    ++report_.counters.leaps;
  }
  last_ = *sample;
  sample->storey = storey_;
  sample->sequence = static_cast<std::uint32_t>(report_.counters.samples);
  count(*sample);
  return ReceivedSample{.sample = *sample};
}

}  // namespace swiftlet
