// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

struct StoreyLevel {
  double above_first_m = 0.0;
  bool is_known = false;  ///< false: the vehicle turned back on the way there, or is still on it
};

/// Tells on which storey a vehicle flies, by the elevation of the ground below it. A step up or down by most
/// of a storey is a change; what changes no faster than the weather moves all storeys together. A storey that
/// was flown before is known again by its elevation. Beyond kMaxStoreys there are no new ones: what is flown
/// there counts to the last. Fixed storage, no allocation, one thread at a time.
class StoreyTracker {
 public:
  /// The next reading: barometric altitude less the height above the ground. Any zero.
  void add(DeviceTime at, double ground_m);
  /// The clock has restarted. Weather meanwhile is not told from a climb.
  void restart() { readings_ = 0; }

  [[nodiscard]] StoreyId current() const { return current_; }
  /// By storey.
  [[nodiscard]] std::span<const StoreyLevel> levels() const { return {levels_.data(), levels_.size()}; }

 private:
  void smooth(DeviceTime at, double ground_m);
  void watch_climb(DeviceTime at, double level_m);
  void stay_or_leave(double level_m);
  void follow_climb(double level_m);
  void begin(double level_m);
  [[nodiscard]] std::optional<StoreyId> nearest_known(double level_m) const;
  [[nodiscard]] bool is_between_known(double level_m) const;
  [[nodiscard]] StoreyLevel& level_of(StoreyId storey) { return levels_[index_of(storey)]; }
  [[nodiscard]] double off_m(StoreyId storey, double level_m) const;

  FixedVector<StoreyLevel, kMaxStoreys> levels_ = only_the_first();
  StoreyId current_{};
  bool is_level_ = false;        // no climb
  double changed_from_m_ = 0.0;  // the level when it had last changed,
  DeviceTime changed_at_{};      // and when
  double climbed_from_m_ = 0.0;  // likewise, by more than furniture is high
  DeviceTime climbed_at_{};
  double smoothed_m_ = 0.0;  // the ground
  double drift_m_ = 0.0;     // of the zero of the readings
  bool has_zero_ = false;
  std::uint64_t readings_ = 0;  // since the clock started
  DeviceTime began_at_{};
  DeviceTime last_at_{};

  static FixedVector<StoreyLevel, kMaxStoreys> only_the_first() {
    FixedVector<StoreyLevel, kMaxStoreys> levels;
    static_cast<void>(levels.try_push_back({0.0, true}));
    return levels;
  }
};

}  // namespace swiftlet
