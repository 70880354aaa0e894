// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/peak_memory.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace swiftlet {
namespace {

TEST(PeakMemory, RemembersWhatWasGivenBack) {
  constexpr std::size_t kMegabytes = 200;
  const double before_mb = peak_memory_mb();
  std::vector<char> held(kMegabytes << 20U, 'x');
  EXPECT_EQ(held.back(), 'x');
  std::vector<char>().swap(held);
  EXPECT_GT(before_mb, 1.0);
  EXPECT_GT(peak_memory_mb() - before_mb, 0.95 * static_cast<double>(kMegabytes));
  reset_peak_memory();
  EXPECT_LT(peak_memory_mb() - before_mb, 0.5 * static_cast<double>(kMegabytes));
}

}  // namespace
}  // namespace swiftlet
