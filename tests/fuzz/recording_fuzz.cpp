// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes as a recording: capture or laser log, by what they begin with.
#include <cstddef>
#include <cstdint>
#include <memory>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/fuzz/check_samples.hpp"
#include "tests/fuzz/memory_file.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const swiftlet::MemoryFile file({data, size});
  const auto source = swiftlet::open_sample_source(file.path(), {});
  if (source) swiftlet::drain(**source);
  return 0;
}
