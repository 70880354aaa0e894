// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/evaluation/stamped_path.hpp"

namespace swiftlet {

/// From the earliest stamp to the latest.
struct TimeSpan {
  HostTime first{};
  HostTime last{};
};
/// Precondition, of both: not empty.
[[nodiscard]] TimeSpan span_of(std::span<const HostTime> stamps);
[[nodiscard]] TimeSpan span_of(const StampedPath& path);

/// The refusal of a file none of whose stamps belongs to the trajectory: kInvalidInput. `what` it lacks. Has
/// both time spans, so that the reader sees whether clock, log or file is another.
[[nodiscard]] Error nothing_in_common(const std::string& file, const char* what, const TimeSpan& of_file,
                                      const TimeSpan& of_trajectory);

}  // namespace swiftlet
