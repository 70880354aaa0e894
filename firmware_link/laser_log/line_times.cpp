// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/line_times.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace swiftlet {
namespace {

constexpr std::size_t kMaxAround = 10;  // lines on either side: about 2 s, several bunches

/// Lines without a pause, [first, end).
void add_regular_times(std::span<const CarmenOdometry> lines, std::vector<DeviceTime>& times) {
  const HostTime zero = lines.front().stamp;
  std::vector<std::uint64_t> sums_ns{0};  // of the stamps before each line; in a long log they wrap
  for (const CarmenOdometry& line : lines)
    sums_ns.push_back(sums_ns.back() + static_cast<std::uint64_t>((line.stamp - zero).count()));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t around = std::min({kMaxAround, i, lines.size() - 1 - i});
    const auto sum_ns = static_cast<Duration::rep>(sums_ns[i + around + 1] - sums_ns[i - around]);
    times.push_back(DeviceTime(zero.time_since_epoch()) +
                    Duration(sum_ns / static_cast<Duration::rep>(2 * around + 1)));
  }
}

}  // namespace

std::vector<DeviceTime> regular_times(std::span<const CarmenOdometry> lines) {
  std::vector<DeviceTime> times;
  times.reserve(lines.size());
  for (std::size_t first = 0; first < lines.size();) {
    std::size_t end = first + 1;
    while (end < lines.size() && lines[end].stamp - lines[end - 1].stamp <= kLongestLineInterval) ++end;
    add_regular_times(lines.subspan(first, end - first), times);
    first = end;
  }
  return times;
}

}  // namespace swiftlet
