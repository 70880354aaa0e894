// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "core/backend/store/scan_store.hpp"
#include "core/base/ids.hpp"

namespace swiftlet {

/// Keyframes of one traversal of its surroundings, about 1.5 m: scans closer in time agree by dead reckoning.
inline constexpr std::uint32_t kKeyframesPerTraversal = 3;

/// Which traversal over its surroundings a scan belongs to.
[[nodiscard]] inline std::uint32_t traversal_of(const StoredScan& scan) {
  return index_of(scan.keyframe) / kKeyframesPerTraversal;
}

}  // namespace swiftlet
