// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <type_traits>

#include "core/base/monotonic_time.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// A sample and when it arrived. Trivially copyable: crosses queues by value.
struct ReceivedSample {
  RangeSample sample;
  /// When the radio frame that completed the sample was received. Not set by a source that is not live: its
  /// samples arrive when they are handed on.
  MonotonicTime arrived_at{};
};
static_assert(std::is_trivially_copyable_v<ReceivedSample>);

}  // namespace swiftlet
