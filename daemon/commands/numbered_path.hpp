// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

namespace swiftlet {

/// Where a later run of one daemon writes to, beside the runs before it: out_2 of out/, flight_2.pcap of
/// flight.pcap.
[[nodiscard]] std::string numbered_path(const std::string& path, int number);

/// Likewise of a log of LCM that is written anew (file://run.lcm?mode=w); any other URL serves all runs as it
/// is. What is no regular file (/dev/null) stays.
[[nodiscard]] std::string numbered_lcm_url(const std::string& url, int number);

}  // namespace swiftlet
