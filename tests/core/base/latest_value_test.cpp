// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/latest_value.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>

namespace swiftlet {
namespace {

TEST(LatestValue, HasNothingNewBeforeTheFirstStore) {
  LatestValue<int> latest;
  int value = 7;
  EXPECT_FALSE(latest.load_if_new(value));
  EXPECT_EQ(value, 7);
}

TEST(LatestValue, GivesTheNewestOnceAndForgetsOlderOnes) {
  LatestValue<int> latest;
  latest.store(1);
  latest.store(2);
  latest.store(3);
  int value = 0;
  ASSERT_TRUE(latest.load_if_new(value));
  EXPECT_EQ(value, 3);
  EXPECT_FALSE(latest.load_if_new(value));
  latest.store(4);
  ASSERT_TRUE(latest.load_if_new(value));
  EXPECT_EQ(value, 4);
}

TEST(LatestValue, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
  using Block = std::array<std::uint64_t, 32>;  // large enough to be caught half written
  constexpr std::uint64_t kLast = 100'000;
  LatestValue<Block> latest;
  std::thread writer([&latest] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      Block block;
      block.fill(i);
      latest.store(block);
    }
  });
  std::uint64_t newest = 0;
  std::uint64_t wrong = 0;
  while (newest < kLast) {
    Block block{};
    if (!latest.load_if_new(block)) {
      std::this_thread::yield();
      continue;
    }
    const bool whole =
        std::all_of(block.begin(), block.end(), [&](std::uint64_t x) { return x == block[0]; });
    if (!whole || block[0] <= newest) ++wrong;
    newest = block[0];
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace swiftlet
