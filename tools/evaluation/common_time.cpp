// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/common_time.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

double seconds_of(HostTime stamp) { return to_seconds(stamp.time_since_epoch()); }

}  // namespace

TimeSpan span_of(std::span<const HostTime> stamps) {
  SWIFTLET_CHECK(!stamps.empty(), "what has a time span has stamps");
  const auto [first, last] = std::minmax_element(stamps.begin(), stamps.end());
  return {*first, *last};
}

TimeSpan span_of(const StampedPath& path) {
  SWIFTLET_CHECK(!path.poses().empty(), "a path that has a time span has poses");
  return {path.poses().front().stamp, path.poses().back().stamp};
}

Error nothing_in_common(const std::string& file, const char* what, const TimeSpan& of_file,
                        const TimeSpan& of_trajectory) {
  return {
      ErrorCode::kInvalidInput,
      fmt::format("{}: {}; its stamps are from {:.6f} to {:.6f} s, the trajectory's from {:.6f} to {:.6f} "
                  "s; are they of one run and one clock?",
                  file, what, seconds_of(of_file.first), seconds_of(of_file.last),
                  seconds_of(of_trajectory.first), seconds_of(of_trajectory.last))};
}

}  // namespace swiftlet
