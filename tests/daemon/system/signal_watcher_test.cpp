// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/signal_watcher.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>

namespace swiftlet {
namespace {

bool is_requested_soon(const std::stop_token& token) {
  for (int i = 0; i < 500 && !token.stop_requested(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return token.stop_requested();
}

TEST(SignalWatcher, RequestsNothingByItself) {
  const SignalWatcher watcher;
  EXPECT_FALSE(watcher.token().stop_requested());
}

TEST(SignalWatcher, TurnsEachSignalIntoARequestToStop) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const SignalWatcher watcher;
    ASSERT_EQ(kill(getpid(), signal), 0);
    EXPECT_TRUE(is_requested_soon(watcher.token())) << signal;
  }
}

TEST(SignalWatcher, AHangupIsACallAndNoRequestToStop) {
  std::atomic<int> calls{0};
  const SignalWatcher watcher([&calls] { ++calls; });
  ASSERT_EQ(kill(getpid(), SIGHUP), 0);
  for (int i = 0; i < 500 && calls == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(watcher.token().stop_requested());
}

TEST(SignalWatcher, AHangupThatTheProgramIgnoredStaysIgnored) {
  const auto before = ::signal(SIGHUP, SIG_IGN);
  {
    const SignalWatcher watcher;
    ASSERT_EQ(kill(getpid(), SIGHUP), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_FALSE(watcher.token().stop_requested());
  }
  ::signal(SIGHUP, before);
}

TEST(SignalWatcher, ASignalThatArrivesTwiceIsOneRequest) {
  // As from timeout(1): once to the program, once to its group.
  const SignalWatcher watcher;
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(kill(getpid(), SIGINT), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(is_requested_soon(watcher.token()));
}

TEST(SignalWatcherDeathTest, ASecondSignalEndsTheProgramAndSaysSo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const SignalWatcher watcher;
        kill(getpid(), SIGTERM);
        is_requested_soon(watcher.token());
        for (int i = 0; i < 500; ++i) {
          kill(getpid(), SIGTERM);
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      },
      testing::KilledBySignal(SIGTERM), "second signal");
}

}  // namespace
}  // namespace swiftlet
