// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "daemon/publish/lcm_url.hpp"
#include "tools/doctor/finding.hpp"
#include "tools/doctor/network.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// "lcm route", "lcm self-test", "lcm buffers": whether what swiftletd publishes arrives.
[[nodiscard]] Findings check_lcm(const LcmUrl& url, Network& network, const SystemFiles& files);

}  // namespace swiftlet
