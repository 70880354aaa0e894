// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "tools/latency/timing_report.hpp"

namespace swiftlet {

/// For people: a line a stage and a line a queue, and how the poses met their deadline.
[[nodiscard]] std::string latency_table(const TimingReport& report);

}  // namespace swiftlet
