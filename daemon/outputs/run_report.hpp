// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "daemon/outputs/run_outputs.hpp"

namespace swiftlet {

/// report.json: what came in, what was made of it, how long it took, and what was wrong. Times and memory
/// aside, the same run gives the same text.
[[nodiscard]] std::string run_report_json(const RunView& run);

}  // namespace swiftlet
