// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/stage_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace swiftlet {
namespace {

TEST(StageQueue, RefusesAndCountsWhatItHasNoRoomFor) {
  StageQueue<int, 2> queue;
  auto in = queue.producer();
  EXPECT_TRUE(in.try_push(1));
  EXPECT_TRUE(in.has_room());
  EXPECT_TRUE(in.try_push(2));
  EXPECT_FALSE(in.has_room());
  EXPECT_FALSE(in.try_push(3));
  EXPECT_EQ(queue.rejected_count(), 1U);
  EXPECT_EQ(queue.high_water(), 2U);
}

TEST(StageQueue, DeliversWhatWasPushedBeforeItWasClosed) {
  StageQueue<int, 4> queue;
  auto in = queue.producer();
  auto out = queue.consumer();
  EXPECT_FALSE(out.closed());
  ASSERT_TRUE(in.try_push(7));
  in.close();
  EXPECT_TRUE(out.closed());
  int item = 0;
  EXPECT_TRUE(out.try_pop(item));
  EXPECT_EQ(item, 7);
  EXPECT_FALSE(out.try_pop(item));
}

TEST(StageQueue, WaitReturnsAtOnceWhenSomethingWaitsOrNothingWillCome) {
  StageQueue<int, 4> queue;
  auto in = queue.producer();
  auto out = queue.consumer();
  ASSERT_TRUE(in.try_push(1));
  out.wait();
  int item = 0;
  ASSERT_TRUE(out.try_pop(item));
  in.close();
  out.wait();
  EXPECT_TRUE(out.closed());
}

TEST(StageQueue, NoItemIsMissedByAConsumerThatSleepsBetweenThem) {
  constexpr int kItems = 20'000;
  StageQueue<int, 8> queue;
  std::jthread producer([in = queue.producer()]() mutable {
    for (int i = 0; i < kItems;) {
      if (in.has_room() && in.try_push(i)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
    in.close();
  });
  auto out = queue.consumer();
  int expected = 0;
  for (bool ended = false; !ended;) {
    const bool closed = out.closed();
    int item = 0;
    if (out.try_pop(item)) {
      ASSERT_EQ(item, expected++);
    } else if (closed) {
      ended = true;
    } else {
      out.wait();
    }
  }
  EXPECT_EQ(expected, kItems);
  EXPECT_EQ(queue.rejected_count(), 0U);
}

}  // namespace
}  // namespace swiftlet
