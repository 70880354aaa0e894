// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/storey_tracker.hpp"

#include <chrono>
#include <cmath>

namespace swiftlet {
namespace {

// Between the landing half way up a flight of stairs (1.5 m) and the lowest storeys (2.5 m, floor to floor).
constexpr double kStoreyChangesM = 1.9;
// As far from one storey as from the next, in the lowest.
constexpr double kSameStoreyM = 1.2;
// Averages a barometer's noise of 0.1 m at 10 Hz to 2 cm, and takes less than a stair's climb.
constexpr double kSmoothedOverS = 2.0;
// Between a climb of the stairs, a minute at most, and weather and ventilation, 2.5 m in ten minutes at most.
constexpr double kDriftOverS = 150.0;
// A new storey is reached where the ground has not risen by so much for so long: slower than any climb.
constexpr double kLevelM = 0.5;
constexpr Duration kLevelFor = std::chrono::seconds(5);

double share_of(double step_s, double over_s) { return 1.0 - std::exp(-step_s / over_s); }

}  // namespace

void StoreyTracker::add(DeviceTime at, double ground_m) {
  if (!has_begun_) smoothed_m_ = drift_m_ = ground_m;
  has_begun_ = true;
  const double step_s = last_at_ ? to_seconds(at - *last_at_) : 0.0;
  if (!last_at_) changed_at_ = at;
  // Behind a restart the ground may be another.
  smoothed_m_ += (last_at_ ? share_of(step_s, kSmoothedOverS) : 1.0) * (ground_m - smoothed_m_);
  last_at_ = at;
  const double level_m = smoothed_m_ - drift_m_;
  if (current_ == last() && !last_is_known_) return follow_new(at, level_m);
  const double off_m = level_m - level_of(current_);
  const bool has_left = std::abs(off_m) > kStoreyChangesM;
  if (const auto other = nearest_known(level_m, has_left ? kStoreyChangesM : 0.5 * std::abs(off_m))) {
    current_ = *other;
    return;
  }
  if (has_left) return begin_new(at, level_m);
  drift_m_ += share_of(step_s, kDriftOverS) * off_m;
}

std::optional<StoreyId> StoreyTracker::nearest_known(double level_m, double within_m) const {
  std::optional<StoreyId> nearest;
  const std::size_t known = levels_m_.size() - (last_is_known_ ? 0 : 1);
  for (std::size_t i = 0; i < known; ++i) {
    const double off_m = std::abs(levels_m_[i] - level_m);
    if (off_m > within_m) continue;
    within_m = off_m;
    nearest = make_id<StoreyId>(i);
  }
  return nearest;
}

/// A new storey is where the climb ends.
void StoreyTracker::follow_new(DeviceTime at, double level_m) {
  if (const std::optional<StoreyId> known = nearest_known(level_m, kSameStoreyM)) {
    current_ = *known;  // the climb led there
    return;
  }
  level_of(current_) = level_m;
  if (std::abs(level_m - changed_from_m_) > kLevelM) {
    changed_from_m_ = level_m;
    changed_at_ = at;
  }
  last_is_known_ = at - changed_at_ >= kLevelFor;
}

void StoreyTracker::begin_new(DeviceTime at, double level_m) {
  if (last_is_known_ && !levels_m_.try_push_back(level_m)) return;
  current_ = last();
  last_is_known_ = false;
  changed_from_m_ = level_m;
  changed_at_ = at;
}

}  // namespace swiftlet
