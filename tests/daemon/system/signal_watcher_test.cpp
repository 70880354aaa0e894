// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/signal_watcher.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>

namespace swiftlet {
namespace {

bool is_soon(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

bool is_requested_soon(const std::stop_token& token) {
  return is_soon([&token] { return token.stop_requested(); });
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
  EXPECT_TRUE(is_soon([&calls] { return calls == 1; }));
  EXPECT_FALSE(watcher.token().stop_requested());
}

TEST(SignalWatcher, AHangupThatTheProgramIgnoredStaysIgnored) {
  const auto before = ::signal(SIGHUP, SIG_IGN);
  {
    const SignalWatcher watcher;
    sigset_t blocked{};
    ASSERT_EQ(pthread_sigmask(SIG_BLOCK, nullptr, &blocked), 0);
    EXPECT_EQ(sigismember(&blocked, SIGHUP), 0);
    EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
  }
  ::signal(SIGHUP, before);
}

TEST(SignalWatcher, TwoSignalsAtOnceAreOneRequest) {
  // As from timeout(1): to the program, and to its group. They wait for the watcher: no time is between them.
  sigset_t both{};
  sigset_t before{};
  sigemptyset(&both);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&both, signal);
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &both, &before), 0);
  for (const int signal : {SIGINT, SIGTERM}) ASSERT_EQ(kill(getpid(), signal), 0);
  {
    const SignalWatcher watcher;
    EXPECT_TRUE(is_requested_soon(watcher.token()));
    EXPECT_TRUE(is_soon([] {
      sigset_t waiting{};
      return sigpending(&waiting) == 0 && sigismember(&waiting, SIGINT) + sigismember(&waiting, SIGTERM) == 0;
    }));
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST(SignalWatcherDeathTest, ASecondSignalEndsTheProgramAndSaysSo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const SignalWatcher watcher;
        kill(getpid(), SIGTERM);
        is_requested_soon(watcher.token());
        for (int i = 0; i < 3000; ++i) {
          kill(getpid(), SIGTERM);
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      },
      testing::KilledBySignal(SIGTERM), "second signal");
}

}  // namespace
}  // namespace swiftlet
