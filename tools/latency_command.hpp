// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/publish/lcm_transport.hpp"

namespace swiftlet {

/// What `swiftlet latency` was asked to do: exactly one of a report and listening.
struct LatencyCommand {
  std::filesystem::path report_file;
  std::filesystem::path picture_file;  ///< empty: none
  bool listen = false;                 ///< to a running swiftletd
  std::string lcm_url = kDefaultLcmUrl;
  std::string channel_prefix = PublishConfig().channel_prefix;
};

/// Prints how a run kept time as a table on stdout, and draws it. Listening it prints a table for each
/// status, until SIGINT, SIGTERM, SIGHUP or the daemon's end.
///
/// Errors: as read_timing_report and LcmTransport::open; kInvalidInput: neither or both were asked for, or a
/// picture while listening; kOutOfSpace: the picture cannot be written.
[[nodiscard]] Status run_latency_command(const LatencyCommand& command);

}  // namespace swiftlet
