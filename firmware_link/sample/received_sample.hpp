// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <type_traits>

#include "core/base/monotonic_time.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// A sample and its time of arrival. Trivially copyable: crosses queues by value.
struct ReceivedSample {
  RangeSample sample;
  /// When the radio frame that completed the sample was received. Not set by a source that is not live: the
  /// time at which the sample is passed on counts.
  MonotonicTime arrived_at{};
};
static_assert(std::is_trivially_copyable_v<ReceivedSample>);

}  // namespace swiftlet
