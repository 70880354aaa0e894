// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

namespace swiftlet::test {

/// Whether this build can count: sanitizers bring a malloc of their own.
[[nodiscard]] bool counts_allocations();

/// Calls to the heap: giving back takes its locks too.
struct HeapCalls {
  std::size_t taken = 0;       ///< malloc and its kin, also by way of operator new
  std::size_t given_back = 0;  ///< free of anything but nullptr

  bool operator==(const HeapCalls&) const = default;
  HeapCalls operator-(const HeapCalls& earlier) const {
    return {taken - earlier.taken, given_back - earlier.given_back};
  }
};

/// By the calling thread since it began. malloc and its kin are interposed in the whole program that links
/// this: counting operator new misses what Eigen and the C library take.
[[nodiscard]] HeapCalls heap_calls_of_this_thread();

/// What the calling thread takes from the heap from here on.
class AllocationCounter {
 public:
  [[nodiscard]] std::size_t count() const { return (heap_calls_of_this_thread() - start_).taken; }

 private:
  HeapCalls start_ = heap_calls_of_this_thread();
};

}  // namespace swiftlet::test
