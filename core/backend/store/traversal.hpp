// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/backend/store/scan_store.hpp"
#include "core/base/ids.hpp"

namespace swiftlet {

/// Keyframes of one traversal of its surroundings, about 1.5 m: scans closer in time agree by dead reckoning.
/// Traversals are pruned as a whole.
inline constexpr std::uint32_t kKeyframesPerTraversal = 3;

[[nodiscard]] inline TraversalId traversal_of(KeyframeId keyframe) {
  return make_id<TraversalId>(index_of(keyframe) / kKeyframesPerTraversal);
}
[[nodiscard]] inline TraversalId traversal_of(const StoredScan& scan) { return traversal_of(scan.keyframe); }

[[nodiscard]] inline IdRange<KeyframeId> keyframes_of(TraversalId traversal) {
  const auto first = make_id<KeyframeId>(std::size_t{index_of(traversal)} * kKeyframesPerTraversal);
  return {first, first + kKeyframesPerTraversal};
}

}  // namespace swiftlet
