// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// Preloaded into a program (LD_PRELOAD) it paints the stack of every thread before the thread begins and,
// when it ends, adds a line to the file that SWIFTLET_STACKS names: the thread's name, how far below its
// first frame the deepest byte lies that was written since, how far below the top of the stack, where the C
// library and thread-local variables come first, and the size of the stack, all in bytes. What was reserved
// but never written, below that byte, is not seen.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

using Word = volatile std::uint64_t;
constexpr std::uint64_t kPaint = 0x5AC3'96E1'5AC3'96E1;
constexpr std::ptrdiff_t kOwnWords = 128;  // what paint() itself may stand on, below its frame's address

/// From the lowest address to one past the highest, where a stack begins.
struct Stack {
  Word* low = nullptr;
  Word* high = nullptr;
};

std::size_t bytes_between(const Word* low, const Word* high) {
  return sizeof(Word) * static_cast<std::size_t>(high - low);
}

Stack stack_of_this_thread() {
  pthread_attr_t attributes;
  void* low = nullptr;
  std::size_t size = 0;
  pthread_getattr_np(pthread_self(), &attributes);
  pthread_attr_getstack(&attributes, &low, &size);
  pthread_attr_destroy(&attributes);
  return {static_cast<Word*>(low), static_cast<Word*>(low) + size / sizeof(Word)};
}

[[gnu::noinline]] void paint(const Stack& stack) {
  const Word* end = static_cast<Word*>(__builtin_frame_address(0)) - kOwnWords;
  for (Word* at = stack.low; at < end; ++at) *at = kPaint;
}

void tell_depth(const Stack& stack, const Word* first_frame) {
  const Word* at = stack.low;
  while (*at == kPaint) ++at;  // ends in this function's own frame at the latest
  const char* path = std::getenv("SWIFTLET_STACKS");
  if (path == nullptr) return;
  std::array<char, 16> name{};
  pthread_getname_np(pthread_self(), name.data(), name.size());
  const int file = ::open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return;
  ::dprintf(file, "%s\t%zu\t%zu\t%zu\n", name.data(), bytes_between(at, first_frame),
            bytes_between(at, stack.high), bytes_between(stack.low, stack.high));
  ::close(file);
}

struct Start {
  void* (*function)(void*);
  void* argument;
};

void* run_painted(void* data) {
  const Start start = *std::unique_ptr<Start>(static_cast<Start*>(data));
  const Stack stack = stack_of_this_thread();
  paint(stack);
  void* result = start.function(start.argument);
  tell_depth(stack, static_cast<Word*>(__builtin_frame_address(0)));
  return result;
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
                              void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const Create kCreate = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  auto start = std::make_unique<Start>(Start{function, argument});
  const int failure = kCreate(thread, attributes, run_painted, start.get());
  if (failure == 0) static_cast<void>(start.release());  // the thread's own now
  return failure;
}
