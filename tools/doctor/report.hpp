// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <string>

#include "tools/doctor/finding.hpp"

namespace swiftlet {

/// "ok", "warning", "problem", "skipped".
[[nodiscard]] const char* text_of(Mark mark);
[[nodiscard]] std::size_t count(const Findings& findings, Mark mark);

/// One line for each finding and one for all together; checks skipped in a row for the same reason share a
/// line. Marks are coloured where `colours` is set.
[[nodiscard]] std::string report_text(const Findings& findings, bool colours);
/// {"input": ..., "ready": bool, "checks": [{"check", "mark", "found", "remedy"}, ...]}
[[nodiscard]] std::string report_json(const std::string& input, const Findings& findings);

}  // namespace swiftlet
