// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// Tells on which storey a vehicle flies, by the elevation of the ground below it. A step up or down by most
/// of a storey is a change; what changes slowly is the weather, which moves all storeys together. A storey
/// that was flown before is known again by its elevation. Fixed storage, no allocation, one thread at a time.
class StoreyTracker {
 public:
  /// The next reading: barometric altitude less the height above the ground. Any zero.
  void add(DeviceTime at, double ground_m);
  /// The clock has restarted.
  void restart() { last_at_.reset(); }

  [[nodiscard]] StoreyId current() const { return current_; }
  /// Of each storey above the first, by id; 0 alone where nothing is known.
  [[nodiscard]] std::span<const double> levels_m() const { return {levels_m_.data(), levels_m_.size()}; }

 private:
  void follow_new(DeviceTime at, double level_m);
  void begin_new(DeviceTime at, double level_m);
  [[nodiscard]] std::optional<StoreyId> nearest_known(double level_m, double within_m) const;
  [[nodiscard]] double& level_of(StoreyId storey) { return levels_m_[index_of(storey)]; }
  [[nodiscard]] StoreyId last() const { return make_id<StoreyId>(levels_m_.size() - 1); }

  FixedVector<double, kMaxStoreys> levels_m_ = only_the_first();
  StoreyId current_{};
  bool last_is_known_ = true;    // its level was reached; before, the next new storey takes its place
  double changed_from_m_ = 0.0;  // the level of that storey when it had last changed,
  DeviceTime changed_at_{};      // and when
  double smoothed_m_ = 0.0;      // the ground
  double drift_m_ = 0.0;         // of the zero of the readings
  bool has_begun_ = false;
  std::optional<DeviceTime> last_at_;

  static FixedVector<double, kMaxStoreys> only_the_first() {
    FixedVector<double, kMaxStoreys> levels;
    static_cast<void>(levels.try_push_back(0.0));
    return levels;
  }
};

}  // namespace swiftlet
