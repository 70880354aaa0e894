// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

namespace swiftlet {

// Counted up from 0 within a run; never reused. Distinct types, so that one cannot be taken for another.
enum class KeyframeId : std::uint32_t {};
enum class LandmarkId : std::uint32_t {};

template <typename Id>
constexpr std::uint32_t index_of(Id id) {
  return static_cast<std::uint32_t>(id);
}

}  // namespace swiftlet
