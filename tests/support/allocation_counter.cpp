// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/allocation_counter.hpp"

#include <cerrno>

namespace {

thread_local swiftlet::test::HeapCalls calls;  // plain numbers: needs no constructor, hence no heap

}  // namespace

#ifndef SWIFTLET_SANITIZED
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_valloc(std::size_t size);
void* __libc_pvalloc(std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) {
  ++calls.taken;
  return __libc_malloc(size);
}
void* calloc(std::size_t items, std::size_t size) {
  ++calls.taken;
  return __libc_calloc(items, size);
}
void* realloc(void* old, std::size_t size) {
  ++calls.taken;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++calls.taken;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++calls.taken;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++calls.taken;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
void* valloc(std::size_t size) {
  ++calls.taken;
  return __libc_valloc(size);
}
void* pvalloc(std::size_t size) {
  ++calls.taken;
  return __libc_pvalloc(size);
}
void free(void* memory) {
  if (memory != nullptr) ++calls.given_back;
  __libc_free(memory);
}
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)
#endif

namespace swiftlet::test {

bool counts_allocations() {
#ifdef SWIFTLET_SANITIZED
  return false;
#else
  return true;
#endif
}

HeapCalls heap_calls_of_this_thread() { return calls; }

}  // namespace swiftlet::test
