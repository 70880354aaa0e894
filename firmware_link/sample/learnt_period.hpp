// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "core/base/fixed_vector.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// Of log blocks that do not say theirs, until it is learnt: the Multiranger measures as often.
inline constexpr Duration kUsualPeriod = std::chrono::milliseconds(100);

/// The period of readings that nobody states: the median of the first times between them, which two lost
/// packets do not change. Fixed storage; one thread at a time.
class LearntPeriod {
 public:
  void add(DeviceTime at) {
    if (last_ && at > *last_) static_cast<void>(spacings_.try_push_back(at - *last_));
    last_ = at;
  }
  [[nodiscard]] bool is_certain() const { return spacings_.full(); }
  /// By what has come; kUsualPeriod if nothing has, and for what differs from it as packets at 10 Hz do.
  [[nodiscard]] Duration period() const {
    if (spacings_.empty()) return kUsualPeriod;
    Spacings spacings = spacings_;
    Duration* const median_at = spacings.begin() + spacings.size() / 2;
    std::nth_element(spacings.begin(), median_at, spacings.end());
    const Duration median = *median_at;
    return std::chrono::abs(median - kUsualPeriod) <= std::chrono::milliseconds(5) ? kUsualPeriod : median;
  }

  using Spacings = FixedVector<Duration, 5>;
  /// What it is learnt from.
  [[nodiscard]] const Spacings& spacings() const { return spacings_; }

 private:
  std::optional<DeviceTime> last_;
  Spacings spacings_;
};

}  // namespace swiftlet
