// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/mapping/picture/painter.hpp"
#include "tools/latency/timing_report.hpp"

namespace swiftlet {

/// A strip a stage, over one axis of time from 1 us to 10 s, both logarithmic: how often a call took so long.
/// Marks at the median, 99 % and 99.9 %; the deadline of the poses as a line through theirs.
[[nodiscard]] RgbImage draw_latencies(const TimingReport& report);

}  // namespace swiftlet
