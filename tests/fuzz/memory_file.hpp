// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <sys/mman.h>
#include <unistd.h>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/check.hpp"

namespace swiftlet {

/// A file in memory, for what reads files by name.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::uint8_t> bytes)
      : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    SWIFTLET_CHECK(written == static_cast<ssize_t>(bytes.size()), "memory takes what a fuzzer makes up");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace swiftlet
