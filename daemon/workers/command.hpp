// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "core/base/fixed_vector.hpp"

namespace swiftlet {

/// What a user asks for while the run goes on.
struct Command {
  enum class Kind : std::uint8_t { kSaveMap, kMarkPlace, kNewMap };
  Kind kind = Kind::kSaveMap;
  FixedVector<char, 60> name;  ///< of the place

  [[nodiscard]] std::string_view name_text() const { return {name.data(), name.size()}; }
};
static_assert(std::is_trivially_copyable_v<Command>);

}  // namespace swiftlet
