// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

namespace swiftlet {

/// How long one stage took over a run.
struct StageSummary {
  std::string name;  ///< "input", "frontend", "backend", "map"
  std::uint64_t count = 0;
  double mean_ms = 0.0;
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

}  // namespace swiftlet
