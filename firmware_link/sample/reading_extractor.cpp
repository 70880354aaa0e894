// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/reading_extractor.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/geometry/angle.hpp"
#include "firmware_link/sample/attitude.hpp"
#include "firmware_link/sample/learnt_period.hpp"

namespace swiftlet {
namespace {

/// A value beyond the variable's own 16 bits is invalid.
std::optional<bool> is_flying(double value, unsigned mask) {
  if (!(value >= 0.0 && value <= 65535.0)) return std::nullopt;
  return (static_cast<unsigned>(value) & mask) != 0;
}

// Beyond that the estimator does not use it either.
constexpr double kZrangeEndsMm = 5000.0;
// A height of 0 for so long from the first one on: no deck measures it. On the floor one reads a centimetre
// or two.
constexpr Duration kStaysZero = std::chrono::seconds(2);
// After a second without the radio the vehicle gives up the link, and with it its blocks: twice that.
constexpr Duration kSilent = std::chrono::seconds(2);
// A longer step from any record to the next is a pause of all.
constexpr Duration kPause = std::chrono::seconds(1);

}  // namespace

const std::array<ReadingExtractor::Form, 3> ReadingExtractor::kPositionForms{
    {{ValueKind::kMetres, 2, {"stateEstimate.x", "stateEstimate.y"}},
     {ValueKind::kMetres, 2, {"kalman.stateX", "kalman.stateY"}},
     {ValueKind::kMillimetres, 2, {"stateEstimateZ.x", "stateEstimateZ.y"}}}};
const std::array<ReadingExtractor::Form, 5> ReadingExtractor::kYawForms{
    {{ValueKind::kDegrees, 1, {"stateEstimate.yaw"}},
     {ValueKind::kQuaternion,
      4,
      {"stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz", "stateEstimate.qw"}},
     {ValueKind::kQuaternion, 4, {"kalman.q1", "kalman.q2", "kalman.q3", "kalman.q0"}},
     {ValueKind::kPackedQuaternion, 1, {"stateEstimateZ.quat"}},
     {ValueKind::kDegrees, 1, {"stabilizer.yaw"}}}};  // stateEstimate.yaw by another name
const std::array<ReadingExtractor::Form, 5> ReadingExtractor::kTiltForms{
    {kYawForms[1],
     kYawForms[2],
     kYawForms[3],
     {ValueKind::kDegrees, 2, {"stateEstimate.roll", "stateEstimate.pitch"}},
     {ValueKind::kDegrees, 2, {"stabilizer.roll", "stabilizer.pitch"}}}};
const std::array<ReadingExtractor::Form, 4> ReadingExtractor::kHeightForms{
    {{ValueKind::kMillimetres, 1, {"range.zrange"}},
     {ValueKind::kMetres, 1, {"stateEstimate.z"}},
     {ValueKind::kMetres, 1, {"kalman.stateZ"}},
     {ValueKind::kMillimetres, 1, {"stateEstimateZ.z"}}}};
const std::array<ReadingExtractor::Form, 1> ReadingExtractor::kAltitudeForms{
    {{ValueKind::kMetres, 1, {"baro.asl"}}}};

std::optional<Reading> ReadingExtractor::extract(const LogRecord& record) {
  const Slots& slots = slots_of(record);
  listen(record);
  const auto offers_ranges = [](const Slots& of) { return of.range_count; };
  const auto offers_flying = [](const Slots& of) -> std::size_t { return of.flying ? 1 : 0; };
  Reading reading;
  reading.stream = record.block_id;
  reading.boot = record.boot;
  reading.at = record.at;
  reading.received = record.received;
  if (takes(position_source_, record, &Slots::position))
    reading.position_odom = read_position(record, slots.position);
  if (takes(yaw_source_, record, &Slots::yaw)) reading.yaw_odom_rad = read_yaw_rad(record, slots.yaw);
  if (takes(tilt_source_, record, &Slots::tilt)) reading.tilt = read_tilt(record, slots.tilt);
  if (takes(height_source_, record, &Slots::height)) reading.height_m = read_height_m(record, slots.height);
  if (takes(altitude_source_, record, &Slots::altitude))
    reading.altitude_m = record.value(*slots.altitude.slots[0]);
  if (slots.range_count > 0 && take_from(range_source_, record, offers_ranges)) {
    for (const Slot& slot : slots.ranges) {
      const double distance_m = slot ? record.value(*slot) * 1e-3 : std::numeric_limits<double>::quiet_NaN();
      static_cast<void>(reading.distance_m.try_push_back(static_cast<float>(distance_m)));
    }
  }
  if (slots.flying && take_from(flying_source_, record, offers_flying))
    reading.is_flying = is_flying(record.value(*slots.flying), slots.flying_mask);
  const bool is_needed = reading.position_odom || reading.yaw_odom_rad || reading.tilt || reading.height_m ||
                         reading.altitude_m || reading.is_flying || !reading.distance_m.empty();
  return is_needed ? std::optional(reading) : std::nullopt;
}

Duration ReadingExtractor::odometry_period() const {
  const Duration position_period = period_of(position_source_);
  const Duration yaw_period = period_of(yaw_source_);
  const bool is_known = std::min(position_period, yaw_period) > Duration::zero();
  return is_known ? std::max(position_period, yaw_period) : Duration::zero();
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
    heard_at_.fill(heard_);
    range_source_.reset();
    position_source_.reset();
    yaw_source_.reset();
    tilt_source_.reset();
    height_source_.reset();
    altitude_source_.reset();
    flying_source_.reset();
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
    if (slots.ranges[i]) ++slots.range_count;
  }
  slots.position = find_first(record, kPositionForms);
  slots.yaw = find_first(record, kYawForms);
  slots.tilt = find_first(record, kTiltForms);
  slots.height = find_first(record, kHeightForms);
  slots.altitude = find_first(record, kAltitudeForms);
  resolve_flying(record, slots);
}

void ReadingExtractor::resolve_flying(const LogRecord& record, Slots& slots) const {
  slots.flying = find(record, "supervisor.info");
  slots.flying_mask = kSupervisorFlying;
  if (slots.flying) return;
  slots.flying_mask = ~0U;
  slots.flying = find(record, "sys.isFlying");                          // firmware before 2023.06
  if (!slots.flying) slots.flying = find(record, "stabilizer.thrust");  // none: the motors are off
}

ReadingExtractor::Quantity ReadingExtractor::find_first(const LogRecord& record,
                                                        std::span<const Form> forms) const {
  for (const Form& form : forms) {
    Quantity quantity{.kind = form.kind};
    bool is_whole = true;
    for (std::size_t i = 0; i < form.count; ++i) {
      quantity.slots[i] = find(record, form.names[i]);
      is_whole = is_whole && quantity.slots[i].has_value();
    }
    if (is_whole) return quantity;
  }
  return {};
}

ReadingExtractor::Slot ReadingExtractor::find(const LogRecord& record, std::string_view name) const {
  for (std::size_t i = 0; i < record.entry_count; ++i)
    if (session_.name_of(record, i) == name) return static_cast<std::uint8_t>(i);
  return std::nullopt;
}

bool ReadingExtractor::takes(std::optional<Source>& source, const LogRecord& record,
                             Quantity Slots::*quantity) {
  const auto offers = [quantity](const Slots& of) -> std::size_t { return of.*quantity ? 1 : 0; };
  return offers(slots_of(record)) > 0 && take_from(source, record, offers);
}

template <typename Offers>
bool ReadingExtractor::take_from(std::optional<Source>& source, const LogRecord& record, Offers offers) {
  if (source && source->block_id == record.block_id) return true;
  const bool is_open = !source || is_silent(*source);
  if (!is_open && !record.described) return false;
  const Source own{record.block_id, record.block->period, offers(slots_of(record))};
  if (is_open)
    source = record.described ? own : source_for(own, offers);
  else if (is_better(own, *source))
    source = own;
  return source->block_id == record.block_id;
}

void ReadingExtractor::listen(const LogRecord& record) {
  const Duration step = newest_at_ ? record.received - *newest_at_ : Duration::zero();
  if (step > Duration::zero() && step < kPause) heard_ += step;
  newest_at_ = record.received;
  heard_at_[record.block_id] = heard_;
}

bool ReadingExtractor::is_silent(const Source& source) const {
  return heard_ - heard_at_[source.block_id] > std::max(kSilent, 3 * source.period);
}

/// Whatever another program logs beside it, a flight is mapped from the same block.
template <typename Offers>
ReadingExtractor::Source ReadingExtractor::source_for(const Source& own, Offers offers) {
  std::optional<Source> best;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto id = static_cast<std::uint8_t>(i);
    const LogBlock& block = session_.blocks()[id];
    if (!block.running || block.period == Duration::zero()) continue;
    const Source source{id, block.period, offers(slots_of_running(id))};
    if (source.offered > 0 && !is_silent(source) && (!best || is_better(source, *best))) best = source;
  }
  return best.value_or(own);
}

bool ReadingExtractor::is_better(const Source& source, const Source& than) {
  if (source.offered != than.offered) return source.offered > than.offered;
  return std::max(source.period, kUsualPeriod) < std::max(than.period, kUsualPeriod);
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

Point2 ReadingExtractor::read_position(const LogRecord& record, const Quantity& position) {
  const double x = record.value(*position.slots[0]);
  const double y = record.value(*position.slots[1]);
  if (position.kind == ValueKind::kMetres) return {x, y};
  return {x_.unwrap_m(x), y_.unwrap_m(y)};
}

double ReadingExtractor::WrappedMillimetres::unwrap_m(double wrapped_mm) {
  if (!(std::abs(wrapped_mm) <= 32768.0)) return wrapped_mm * 1e-3;  // requested in a wider type
  const auto step = static_cast<std::int16_t>(std::llround(wrapped_mm) - value_mm);
  value_mm += step;
  return static_cast<double>(value_mm) * 1e-3;
}

double ReadingExtractor::read_yaw_rad(const LogRecord& record, const Quantity& yaw) {
  if (yaw.kind == ValueKind::kDegrees) return wrap_angle(radians(record.value(*yaw.slots[0])));
  return yaw_of(read_quaternion(record, yaw));
}

BodyTilt ReadingExtractor::read_tilt(const LogRecord& record, const Quantity& tilt) {
  if (tilt.kind == ValueKind::kDegrees)
    return tilt_of(radians(record.value(*tilt.slots[0])), radians(record.value(*tilt.slots[1])));
  return tilt_of(read_quaternion(record, tilt));
}

double ReadingExtractor::read_height_m(const LogRecord& record, const Quantity& height) {
  const double value = record.value(*height.slots[0]);
  if (height.kind == ValueKind::kMetres) return value;
  if (!height_since_) height_since_ = record.received;
  has_height_ = has_height_ || value != 0.0;
  const bool has_none = !has_height_ && record.received - *height_since_ > kStaysZero;
  return value < kZrangeEndsMm && !has_none ? value * 1e-3 : std::numeric_limits<double>::quiet_NaN();
}

Quaternion ReadingExtractor::read_quaternion(const LogRecord& record, const Quantity& quantity) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](std::size_t i) { return record.value(*quantity.slots[i]); };
  if (quantity.kind == ValueKind::kQuaternion) return {value(0), value(1), value(2), value(3)};
  const double packed = value(0);
  const bool is_packed = packed >= 0.0 && packed <= std::numeric_limits<std::uint32_t>::max();
  return is_packed ? unpack_quaternion(static_cast<std::uint32_t>(packed))
                   : Quaternion{kNan, kNan, kNan, kNan};
}

}  // namespace swiftlet
