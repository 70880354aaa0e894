// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes as what `swiftlet eval` reads: a trajectory and a reference, which are held against each other.
#include <cstddef>
#include <cstdint>

#include "core/evaluation/relation_error.hpp"
#include "core/evaluation/trajectory_error.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tools/evaluation/reference_kind.hpp"
#include "tools/evaluation/relations_file.hpp"
#include "tools/evaluation/tum_file.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const swiftlet::MemoryFile file({data, size});
  static_cast<void>(swiftlet::recognise_reference(file.path()));
  const auto relations = swiftlet::read_relations_file(file.path());
  const auto poses = swiftlet::read_tum_file(file.path());
  if (!poses) return 0;
  const swiftlet::StampedPath path(*poses);
  static_cast<void>(swiftlet::path_error(path, path));
  if (relations) static_cast<void>(swiftlet::relation_error(*relations, path));
  return 0;
}
