// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/thread_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace swiftlet {
namespace {

/// A thread that waits to be looked at.
class Sleeper {
 public:
  ~Sleeper() {
    over_ = true;
    over_.notify_one();
  }
  [[nodiscard]] pthread_t handle() { return thread_.native_handle(); }

 private:
  std::atomic<bool> over_{false};
  std::jthread thread_{[this] { over_.wait(false); }};
};

int policy_of(pthread_t thread, int& priority) {
  int policy = -1;
  sched_param parameters{};
  pthread_getschedparam(thread, &policy, &parameters);
  priority = parameters.sched_priority;
  return policy;
}

TEST(ThreadSetup, OfNothingLeavesTheThreadAsItIs) {
  Sleeper sleeper;
  ASSERT_TRUE(set_up_thread(sleeper.handle(), {}).ok());
  int priority = -1;
  EXPECT_EQ(policy_of(sleeper.handle(), priority), SCHED_OTHER);
}

TEST(ThreadSetup, GivesThePriorityOrSaysThatItMayNot) {
  Sleeper sleeper;
  const Status given = set_up_thread(sleeper.handle(), {.fifo_priority = 7});
  int priority = -1;
  const int policy = policy_of(sleeper.handle(), priority);
  if (given) {
    EXPECT_EQ(policy, SCHED_FIFO);
    EXPECT_EQ(priority, 7);
  } else {
    EXPECT_EQ(policy, SCHED_OTHER);
    EXPECT_EQ(given.error().message, "SCHED_FIFO priority 7: Operation not permitted");
  }
}

TEST(ThreadSetup, PutsTheThreadOnItsProcessor) {
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int cpu = 0;
  while (!CPU_ISSET(static_cast<std::size_t>(cpu), &allowed)) ++cpu;
  Sleeper sleeper;
  ASSERT_TRUE(set_up_thread(sleeper.handle(), {.cpu = cpu}).ok());
  cpu_set_t now;
  ASSERT_EQ(pthread_getaffinity_np(sleeper.handle(), sizeof now, &now), 0);
  EXPECT_EQ(CPU_COUNT(&now), 1);
  EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(cpu), &now));
}

TEST(ThreadSetup, SaysThatTheMachineHasNoSuchProcessor) {
  Sleeper sleeper;
  const Status given = set_up_thread(sleeper.handle(), {.cpu = 1023});
  ASSERT_FALSE(given.ok());
  EXPECT_THAT(given.error().message, testing::StartsWith("processor 1023: "));
}

TEST(ThreadSetup, ATouchedStackHasNoPageMissing) {
  std::jthread([] {
    prefault_stack();
    rusage before{};
    rusage after{};
    ASSERT_EQ(getrusage(RUSAGE_THREAD, &before), 0);
    prefault_stack();
    ASSERT_EQ(getrusage(RUSAGE_THREAD, &after), 0);
    EXPECT_LT(after.ru_minflt - before.ru_minflt, 16) << "of 64 pages";
  });
}

bool is_the_systems_allocator() {
  const std::size_t before = mallinfo2().uordblks;
  const std::vector<std::byte> block(std::size_t{64} * 1024);
  return mallinfo2().uordblks > before;
}

TEST(ThreadSetup, FreedMemoryStaysWithTheProcess) {
  if (!is_the_systems_allocator()) GTEST_SKIP() << "a sanitizer's allocator heeds no limits";
  if (sizeof(void*) < 8) GTEST_SKIP() << "on 32 bits the heap of a thread is 1 MiB at most";
  keep_freed_memory();
  std::jthread([] {
    constexpr std::size_t kBytes = std::size_t{3} * 1024 * 1024;
    const auto touched = [] { return std::vector<std::byte>(kBytes).size(); };
    ASSERT_EQ(touched(), kBytes);
    rusage before{};
    rusage after{};
    ASSERT_EQ(getrusage(RUSAGE_THREAD, &before), 0);
    ASSERT_EQ(touched(), kBytes);
    ASSERT_EQ(getrusage(RUSAGE_THREAD, &after), 0);
    EXPECT_LT(after.ru_minflt - before.ru_minflt, 16) << "of 768 pages";
  });
}

}  // namespace
}  // namespace swiftlet
