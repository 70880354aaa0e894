// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes as the description of log blocks beside a capture.
#include <cstddef>
#include <cstdint>

#include "firmware_link/session/block_description.hpp"
#include "firmware_link/session/log_session.hpp"
#include "tests/fuzz/memory_file.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const swiftlet::MemoryFile file({data, size});
  const auto description = swiftlet::read_block_description(file.path());
  if (!description) return 0;
  swiftlet::LogSession session;
  session.describe(*description);
  return 0;
}
