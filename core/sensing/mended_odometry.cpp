// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/mended_odometry.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace swiftlet {

Pose2 as_reported(std::span<const MendedOdometry> mended, HostTime stamp, const Pose2& T_mended) {
  const auto after = std::ranges::upper_bound(mended, stamp, {}, &MendedOdometry::since);
  if (after == mended.begin()) return T_mended;
  return std::prev(after)->T_mended_reported.inverse() * T_mended;
}

std::vector<MendedOdometry> mended_in_turn(std::span<const MendedOdometry> first,
                                           std::span<const MendedOdometry> then) {
  std::vector<MendedOdometry> both;
  MendedOdometry earlier;
  MendedOdometry later;
  for (std::size_t i = 0, j = 0; i < first.size() || j < then.size();) {
    const bool has_first = j == then.size() || (i < first.size() && first[i].since <= then[j].since);
    const bool has_then = i == first.size() || (j < then.size() && then[j].since <= first[i].since);
    const HostTime since = has_first ? first[i].since : then[j].since;
    if (has_first) earlier = first[i++];
    if (has_then) later = then[j++];
    both.push_back({since, later.T_mended_reported * earlier.T_mended_reported, later.reversed});
  }
  return both;
}

}  // namespace swiftlet
