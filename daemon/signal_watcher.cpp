// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/signal_watcher.hpp"

#include <pthread.h>

namespace swiftlet {
namespace {

constexpr timespec kLookEvery{.tv_sec = 0,
                              .tv_nsec = 50'000'000};  // how soon the end of the watch is noticed

}  // namespace

SignalWatcher::SignalWatcher() {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGINT);
  sigaddset(&watched_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &watched_, &previous_);
  thread_ = std::jthread([this](const std::stop_token& over) { watch(over); });
}

SignalWatcher::~SignalWatcher() {
  thread_.request_stop();
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void SignalWatcher::watch(const std::stop_token& over) {
  pthread_setname_np(pthread_self(), "signals");
  while (!over.stop_requested()) {
    if (sigtimedwait(&watched_, nullptr, &kLookEvery) < 0) continue;
    signalled_.request_stop();
    break;
  }
  // This thread stays and lets the signals through, so that the next one ends the program.
  pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
  while (!over.stop_requested()) nanosleep(&kLookEvery, nullptr);
}

}  // namespace swiftlet
