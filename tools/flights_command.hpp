// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "daemon/outputs/output_directory.hpp"

namespace swiftlet {

/// What `swiftlet flights` was asked to do.
struct FlightsCommand {
  std::string directory = kFlightsDirectory;
};

/// Lists the folders of the directory to stdout, a line each, the oldest first: length and duration of the
/// flight, loop closures, the path of its thumbnail, from report.json. Other files and folders without a
/// report that no run writes to are left out. Error: kNotFound: there is no such directory.
[[nodiscard]] Status run_flights_command(const FlightsCommand& command);

}  // namespace swiftlet
