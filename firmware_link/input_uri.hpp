// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// What an input's URI names.
struct InputUri {
  enum class Kind { kFile, kSimulation };
  Kind kind = Kind::kFile;
  std::string path;        ///< kFile
  std::string world;       ///< kSimulation
  std::uint64_t seed = 1;  ///< kSimulation
};

/// `replay:FILE`, `sim://WORLD?seed=N` or a plain path. Errors: kInvalidInput, with a line for the user.
[[nodiscard]] Result<InputUri> parse_input_uri(const std::string& uri);

}  // namespace swiftlet
