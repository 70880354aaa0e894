// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "tools/doctor/finding.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// "real time" and "memory lock": what this user's programs may ask of the scheduler and of memory.
[[nodiscard]] Findings check_real_time(const SystemFiles& files);

}  // namespace swiftlet
