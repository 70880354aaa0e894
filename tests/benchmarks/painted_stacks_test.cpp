// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>
#include <pthread.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kHeld = std::size_t{200} * 1024;

/// Goes `kHeld` deep, writes the deepest byte of that and nothing else, and comes back.
[[gnu::noinline]] void go_deep() {
  std::array<volatile char, kHeld> held;
  held[0] = 1;
  EXPECT_EQ(held[0], 1);
}

TEST(PaintedStacks, TellHowDeepEachThreadWentByItsName) {
  const TemporaryFile report("stacks");
  ASSERT_EQ(::setenv("SWIFTLET_STACKS", report.path().c_str(), 1), 0);
  std::thread([] { ::pthread_setname_np(::pthread_self(), "shallow"); }).join();
  std::thread([] {
    ::pthread_setname_np(::pthread_self(), "deep");
    go_deep();
  }).join();

  std::map<std::string, std::size_t> depth_of;
  std::ifstream lines(report.path());
  std::string name;
  for (std::size_t depth = 0, from_top = 0, size = 0; lines >> name >> depth >> from_top >> size;) {
    depth_of[name] = depth;
    EXPECT_GT(from_top, depth);
    EXPECT_GT(size, std::size_t{1024} * 1024) << "the stack's own size";
  }
  ASSERT_EQ(depth_of.size(), 2U);
  constexpr std::size_t kAround = std::size_t{16} * 1024;  // for starting, ending and looking symbols up
  EXPECT_GT(depth_of["shallow"], 0U);
  EXPECT_LT(depth_of["shallow"], kAround);
  EXPECT_GE(depth_of["deep"], kHeld);
  EXPECT_LT(depth_of["deep"], kHeld + kAround);
}

}  // namespace
}  // namespace swiftlet
