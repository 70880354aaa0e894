// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// How much is unpacked at once.
inline constexpr std::size_t kUnpackedChunk = std::size_t{1} << 18;

/// By content: the magic number of gzip. False if the file cannot be read.
[[nodiscard]] bool begins_like_gzip(const std::string& path);

/// What a gzip file holds, in memory.
struct UnpackedFile {
  std::string bytes;
  bool is_damaged = false;  ///< cut off or garbled behind these bytes
};
/// kInvalidInput: it cannot be read, or holds more than `max_bytes`.
[[nodiscard]] Result<UnpackedFile> unpack_gzip(const std::string& path, std::size_t max_bytes);

}  // namespace swiftlet
