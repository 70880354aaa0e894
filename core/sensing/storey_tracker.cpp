// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/storey_tracker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace swiftlet {
namespace {

// Between the landing half way up a flight of stairs (1.5 m) and the lowest storeys (2.5 m, floor to floor)
// less what a minute of climbing loses to the weather and to its compensation (0.5 m).
constexpr double kStoreyChangesM = 1.75;
// As far from one storey as from the next, in the lowest.
constexpr double kSameStoreyM = 1.2;
// Averages a barometer's noise of 0.1 m at 10 Hz to 2 cm, and takes less than a climb.
constexpr Duration kSmoothedOver = std::chrono::seconds(2);
// Weather and ventilation move the pressure by 2.5 m in ten minutes at most.
constexpr double kDriftMPerS = 0.004;
// A climb has ended where the ground has changed by less than a tenth of the lowest storey for as long as the
// fastest climb takes.
constexpr double kLevelM = 0.25;
constexpr Duration kLevelFor = std::chrono::seconds(10);
// ... or by less than tables and beds are high, over which it changes all the time, for longer than the
// slowest climb, of the lowest storey in a minute, takes for as much (24 s).
constexpr double kFurnitureM = 1.0;
constexpr Duration kFurnishedFor = std::chrono::seconds(30);

}  // namespace

void StoreyTracker::add(DeviceTime at, double ground_m) {
  const double step_s = readings_ == 0 ? 0.0 : std::max(0.0, to_seconds(at - last_at_));
  smooth(at, ground_m);
  if (at - began_at_ < kSmoothedOver) return;
  if (!has_zero_) drift_m_ = smoothed_m_;
  has_zero_ = true;
  if (level_of(current_).is_known) {
    const double most_m = kDriftMPerS * step_s;
    drift_m_ += std::clamp(smoothed_m_ - drift_m_ - level_of(current_).above_first_m, -most_m, most_m);
  }
  const double level_m = smoothed_m_ - drift_m_;
  watch_climb(at, level_m);
  if (level_of(current_).is_known)
    stay_or_leave(level_m);
  else
    follow_climb(level_m);
}

/// The first readings count alike.
void StoreyTracker::smooth(DeviceTime at, double ground_m) {
  if (readings_++ == 0) {
    began_at_ = changed_at_ = climbed_at_ = last_at_ = at;
    smoothed_m_ = 0.0;
  }
  const double step_s = std::max(0.0, to_seconds(at - last_at_));
  const double share = 1.0 - std::exp(-step_s / to_seconds(kSmoothedOver));
  smoothed_m_ += std::max(share, 1.0 / static_cast<double>(readings_)) * (ground_m - smoothed_m_);
  last_at_ = std::max(last_at_, at);
}

void StoreyTracker::watch_climb(DeviceTime at, double level_m) {
  if (std::abs(level_m - changed_from_m_) > kLevelM) {
    changed_from_m_ = level_m;
    changed_at_ = at;
  }
  if (std::abs(level_m - climbed_from_m_) > kFurnitureM) {
    climbed_from_m_ = level_m;
    climbed_at_ = at;
  }
  is_level_ = at - changed_at_ >= kLevelFor || at - climbed_at_ >= kFurnishedFor;
}

double StoreyTracker::off_m(StoreyId storey, double level_m) const {
  return std::abs(level_m - levels_[index_of(storey)].above_first_m);
}

std::optional<StoreyId> StoreyTracker::nearest_known(double level_m) const {
  std::optional<StoreyId> nearest;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const auto storey = make_id<StoreyId>(i);
    if (levels_[i].is_known && (!nearest || off_m(storey, level_m) < off_m(*nearest, level_m)))
      nearest = storey;
  }
  return nearest;
}

bool StoreyTracker::is_between_known(double level_m) const {
  const auto is_above = [&](const StoreyLevel& level) {
    return level.is_known && level.above_first_m > level_m;
  };
  const auto is_below = [&](const StoreyLevel& level) {
    return level.is_known && level.above_first_m < level_m;
  };
  return std::ranges::any_of(levels_, is_above) && std::ranges::any_of(levels_, is_below);
}

/// Between two known storeys the climb leads to one of them, unless it ends.
void StoreyTracker::stay_or_leave(double level_m) {
  const StoreyId nearest = *nearest_known(level_m);  // the present one is known
  const bool is_near_any = off_m(nearest, level_m) <= kStoreyChangesM;
  const bool has_left = off_m(current_, level_m) > kStoreyChangesM;
  if (!is_near_any && (is_level_ || !is_between_known(level_m))) return begin(level_m);
  const bool is_nearer = off_m(nearest, level_m) < 0.5 * off_m(current_, level_m);
  if (is_nearer || (has_left && is_near_any)) current_ = nearest;
}

/// A new storey is where the climb ends.
void StoreyTracker::follow_climb(double level_m) {
  const std::optional<StoreyId> known = nearest_known(level_m);
  if (known && off_m(*known, level_m) < kSameStoreyM) {
    current_ = *known;
    return;
  }
  level_of(current_) = {level_m, is_level_};
}

/// What was seen on a climb that was given up belongs to the storey that it led to.
void StoreyTracker::begin(double level_m) {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const auto storey = make_id<StoreyId>(i);
    if (levels_[i].is_known || off_m(storey, level_m) > kStoreyChangesM) continue;
    current_ = storey;
    return follow_climb(level_m);
  }
  if (levels_.try_push_back({level_m, false})) current_ = make_id<StoreyId>(levels_.size() - 1);
}

}  // namespace swiftlet
