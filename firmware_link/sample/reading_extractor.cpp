// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/reading_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/geometry/angle.hpp"
#include "firmware_link/sample/attitude.hpp"

namespace swiftlet {
namespace {

/// A value beyond the variable's own 16 bits is invalid.
std::optional<bool> is_flying(double value, unsigned mask) {
  if (!(value >= 0.0 && value <= 65535.0)) return std::nullopt;
  return (static_cast<unsigned>(value) & mask) != 0;
}

}  // namespace

std::optional<Reading> ReadingExtractor::extract(const LogRecord& record) {
  const Slots& slots = slots_of(record);
  const auto offers_position = [](const Slots& of) { return of.position != PositionKind::kNone; };
  const auto offers_yaw = [](const Slots& of) { return of.yaw != YawKind::kNone; };
  const auto offers_ranges = [](const Slots& of) { return of.has_ranges; };
  Reading reading;
  reading.stream = record.block_id;
  reading.boot = record.boot;
  reading.at = record.at;
  reading.received = record.received;
  if (offers_position(slots) && take_from(position_source_, record, offers_position))
    reading.position_odom = read_position(record, slots);
  if (offers_yaw(slots) && take_from(yaw_source_, record, offers_yaw))
    reading.yaw_odom_rad = read_yaw_rad(record, slots);
  if (offers_ranges(slots) && take_from(range_source_, record, offers_ranges)) {
    for (const Slot& slot : slots.ranges) {
      const double distance_m = slot ? record.value(*slot) * 1e-3 : std::numeric_limits<double>::quiet_NaN();
      static_cast<void>(reading.distance_m.try_push_back(static_cast<float>(distance_m)));
    }
  }
  if (!reading.position_odom && !reading.yaw_odom_rad && reading.distance_m.empty()) return std::nullopt;
  if (slots.flying) reading.is_flying = is_flying(record.value(*slots.flying), slots.flying_mask);
  return reading;
}

Duration ReadingExtractor::odometry_period() const {
  return std::max(period_of(position_source_), period_of(yaw_source_));
}

std::vector<std::string> ReadingExtractor::missing_ranges() const {
  std::vector<std::string> missing;
  if (!range_source_) return missing;
  const Slots& slots = slots_[range_source_->block_id];
  for (std::size_t i = 0; i < kRangeVariables.size(); ++i)
    if (!slots.ranges[i]) missing.emplace_back(kRangeVariables[i]);
  return missing;
}

const ReadingExtractor::Slots& ReadingExtractor::slots_of(const LogRecord& record) {
  if (revision_ != session_.revision()) {
    revision_ = session_.revision();
    for (Slots& slots : slots_) slots.resolved = false;
    range_source_.reset();
    position_source_.reset();
    yaw_source_.reset();
  }
  Slots& slots = slots_[record.block_id];
  if (!slots.resolved) resolve(record, slots);
  return slots;
}

void ReadingExtractor::resolve(const LogRecord& record, Slots& slots) const {
  slots = {};
  slots.resolved = true;
  for (std::size_t i = 0; i < kRangeVariables.size(); ++i) {
    slots.ranges[i] = find(record, kRangeVariables[i]);
    slots.has_ranges = slots.has_ranges || slots.ranges[i].has_value();
  }
  resolve_position(record, slots);
  resolve_yaw(record, slots);
  resolve_flying(record, slots);
}

void ReadingExtractor::resolve_flying(const LogRecord& record, Slots& slots) const {
  slots.flying = find(record, "supervisor.info");
  slots.flying_mask = kSupervisorFlying;
  if (slots.flying) return;
  slots.flying = find(record, "sys.isFlying");  // firmware before 2023.06
  slots.flying_mask = ~0U;
}

void ReadingExtractor::resolve_position(const LogRecord& record, Slots& slots) const {
  struct Row {
    PositionKind kind;
    std::array<std::string_view, 2> names;
  };
  static constexpr std::array<Row, 3> kRows{
      {{PositionKind::kMetres, {"stateEstimate.x", "stateEstimate.y"}},
       {PositionKind::kMetres, {"kalman.stateX", "kalman.stateY"}},
       {PositionKind::kMillimetres, {"stateEstimateZ.x", "stateEstimateZ.y"}}}};
  for (const Row& row : kRows) {
    if (!find_all(record, row.names, slots.position_slots)) continue;
    slots.position = row.kind;
    return;
  }
}

void ReadingExtractor::resolve_yaw(const LogRecord& record, Slots& slots) const {
  struct Row {
    YawKind kind;
    std::size_t count;
    std::array<std::string_view, 4> names;
  };
  static constexpr std::array<Row, 5> kRows{
      {{YawKind::kDegrees, 1, {"stateEstimate.yaw"}},
       {YawKind::kQuaternion,
        4,
        {"stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz", "stateEstimate.qw"}},
       {YawKind::kQuaternion, 4, {"kalman.q1", "kalman.q2", "kalman.q3", "kalman.q0"}},
       {YawKind::kPackedQuaternion, 1, {"stateEstimateZ.quat"}},
       {YawKind::kDegrees, 1, {"stabilizer.yaw"}}}};  // stateEstimate.yaw by another name
  for (const Row& row : kRows) {
    if (!find_all(record, std::span(row.names).first(row.count), slots.yaw_slots)) continue;
    slots.yaw = row.kind;
    return;
  }
}

bool ReadingExtractor::find_all(const LogRecord& record, std::span<const std::string_view> names,
                                std::span<Slot> slots) const {
  bool complete = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    slots[i] = find(record, names[i]);
    complete = complete && slots[i].has_value();
  }
  return complete;
}

ReadingExtractor::Slot ReadingExtractor::find(const LogRecord& record, std::string_view name) const {
  for (std::size_t i = 0; i < record.entry_count; ++i)
    if (session_.name_of(record, i) == name) return static_cast<std::uint8_t>(i);
  return std::nullopt;
}

template <typename Offers>
bool ReadingExtractor::take_from(std::optional<Source>& source, const LogRecord& record, Offers offers) {
  if (!source) source = source_for(record, offers);
  return source->block_id == record.block_id;
}

/// Whatever another program logs beside it, a flight is mapped from the same block.
template <typename Offers>
ReadingExtractor::Source ReadingExtractor::source_for(const LogRecord& record, Offers offers) {
  if (!record.described) {
    for (std::uint8_t id = 0; id < record.block_id; ++id) {
      const LogBlock& block = session_.blocks()[id];
      const bool sends = block.running && block.period > Duration::zero();
      if (sends && offers(slots_of_running(id))) return {id, block.period};
    }
  }
  return {record.block_id, record.block->period};
}

/// Before its first data, which may not hold all of it.
const ReadingExtractor::Slots& ReadingExtractor::slots_of_running(std::uint8_t block_id) {
  Slots& slots = slots_[block_id];
  if (slots.resolved) return slots;
  LogRecord record;
  record.block_id = block_id;
  record.block = &session_.blocks()[block_id];
  record.entry_count = record.block->entries.size();
  resolve(record, slots);
  slots.resolved = false;
  return slots;
}

Duration ReadingExtractor::period_of(const std::optional<Source>& source) {
  return source ? source->period : Duration::zero();
}

Point2 ReadingExtractor::read_position(const LogRecord& record, const Slots& slots) {
  const double x = record.value(*slots.position_slots[0]);
  const double y = record.value(*slots.position_slots[1]);
  if (slots.position == PositionKind::kMetres) return {x, y};
  return {x_.unwrap_m(x), y_.unwrap_m(y)};
}

double ReadingExtractor::WrappedMillimetres::unwrap_m(double wrapped_mm) {
  if (!(std::abs(wrapped_mm) <= 32768.0)) return wrapped_mm * 1e-3;  // requested in a wider type
  const auto step = static_cast<std::int16_t>(std::llround(wrapped_mm) - value_mm);
  value_mm += step;
  return static_cast<double>(value_mm) * 1e-3;
}

double ReadingExtractor::read_yaw_rad(const LogRecord& record, const Slots& slots) {
  switch (slots.yaw) {
    case YawKind::kDegrees:
      return wrap_angle(radians(record.value(*slots.yaw_slots[0])));
    case YawKind::kQuaternion:
      return yaw_of({record.value(*slots.yaw_slots[0]), record.value(*slots.yaw_slots[1]),
                     record.value(*slots.yaw_slots[2]), record.value(*slots.yaw_slots[3])});
    case YawKind::kPackedQuaternion: {
      const double packed = record.value(*slots.yaw_slots[0]);
      const bool is_packed = packed >= 0.0 && packed <= std::numeric_limits<std::uint32_t>::max();
      if (!is_packed) break;  // requested in a type that cannot hold it
      return yaw_of(unpack_quaternion(static_cast<std::uint32_t>(packed)));
    }
    case YawKind::kNone:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace swiftlet
