// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

namespace swiftlet::test {

/// Whether this build can count: sanitizers bring a malloc of their own.
[[nodiscard]] bool counts_allocations();

/// Counts what the calling thread takes from the heap while it lives, by interposing malloc and its kin in
/// the whole program: counting operator new misses what Eigen takes. One at a time in a thread.
class AllocationCounter {
 public:
  AllocationCounter();
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;

  [[nodiscard]] std::size_t count() const;
};

}  // namespace swiftlet::test
