// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// What `swiftlet record` was asked to do.
struct RecordCommand {
  std::string input;              ///< URI of a vehicle or a simulation
  std::string file;               ///< must not be there yet
  std::optional<double> seconds;  ///< of the link's time; empty: until a signal comes
};

/// "4521 samples, 10.0 Hz, 45 gaps, 296 kB".
[[nodiscard]] std::string recording_summary(std::uint64_t samples, double rate_hz, std::uint64_t gaps,
                                            std::uint64_t bytes);

/// Records what the vehicle sends until the time is up, the input ends or SIGINT, SIGTERM or SIGHUP comes; no
/// SLAM. A summary goes to stdout at the end; notes and warnings of the input and, on a terminal, a running
/// line to stderr.
///
/// Errors: kInvalidInput, kNotFound: input or file cannot be used, or not one sample was received.
/// kOutOfSpace: the recording has ended early or has a hole; the file holds the rest.
[[nodiscard]] Status run_record_command(const RecordCommand& command);

}  // namespace swiftlet
