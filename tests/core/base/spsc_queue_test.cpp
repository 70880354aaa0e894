// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/spsc_queue.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace swiftlet {
namespace {

TEST(SpscQueue, RefusesTheNewestWhenFullAndCountsIt) {
  SpscQueue<int, 2> queue;
  auto producer = queue.producer();
  auto consumer = queue.consumer();
  EXPECT_TRUE(producer.try_push(1));
  EXPECT_TRUE(producer.try_push(2));
  EXPECT_FALSE(producer.try_push(3));
  EXPECT_FALSE(producer.try_push(4));
  EXPECT_EQ(queue.rejected_count(), 2U);
  int item = 0;
  ASSERT_TRUE(consumer.try_pop(item));
  EXPECT_EQ(item, 1);
  EXPECT_TRUE(producer.try_push(5));
  ASSERT_TRUE(consumer.try_pop(item));
  EXPECT_EQ(item, 2);
  ASSERT_TRUE(consumer.try_pop(item));
  EXPECT_EQ(item, 5);
  EXPECT_FALSE(consumer.try_pop(item));
}

TEST(SpscQueue, RemembersTheMostThatEverWaited) {
  SpscQueue<int, 8> queue;
  auto producer = queue.producer();
  auto consumer = queue.consumer();
  EXPECT_EQ(queue.high_water(), 0U);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(producer.try_push(i));
  EXPECT_EQ(consumer.size(), 3U);
  int item = 0;
  while (consumer.try_pop(item)) {
  }
  ASSERT_TRUE(producer.try_push(9));
  EXPECT_EQ(queue.high_water(), 3U);
}

// Each item carries its number twice: a torn copy would show.
struct Numbered {
  std::uint64_t number = 0;
  std::uint64_t again = 0;
};

TEST(SpscQueue, DeliversEverythingOnceAndInOrderBetweenTwoThreads) {
  constexpr std::uint64_t kItems = 200'000;
  SpscQueue<Numbered, 64> queue;
  std::thread writer([producer = queue.producer()]() mutable {
    for (std::uint64_t i = 0; i < kItems;) {
      if (producer.try_push({i, i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  auto consumer = queue.consumer();
  std::uint64_t wrong = 0;
  for (std::uint64_t expected = 0; expected < kItems;) {
    Numbered item;
    if (!consumer.try_pop(item)) {
      std::this_thread::yield();
      continue;
    }
    if (item.number != expected || item.again != expected) ++wrong;
    ++expected;
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(consumer.size(), 0U);
}

}  // namespace
}  // namespace swiftlet
