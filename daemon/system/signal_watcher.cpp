// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/signal_watcher.hpp"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <string_view>
#include <utility>

namespace swiftlet {
namespace {

using std::chrono::steady_clock;

// How soon the end of the watch is noticed.
constexpr timespec kLookEvery{.tv_sec = 0, .tv_nsec = 50'000'000};
// What arrives sooner after the first signal is the same request, sent twice.
constexpr std::chrono::seconds kSameRequest{1};
constexpr std::string_view kFarewell = "ended at once by a second signal: what was not written is lost\n";

/// As nohup(1) has it. A signal that is blocked would come nevertheless.
bool ignores_hangups() {
  struct sigaction present {};
  return ::sigaction(SIGHUP, nullptr, &present) == 0 && present.sa_handler == SIG_IGN;
}

}  // namespace

SignalWatcher::SignalWatcher(std::function<void()> on_hangup) : on_hangup_(std::move(on_hangup)) {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGINT);
  sigaddset(&watched_, SIGTERM);
  if (on_hangup_ || !ignores_hangups()) sigaddset(&watched_, SIGHUP);
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
  steady_clock::time_point asked_at{};
  while (!over.stop_requested()) {
    const int signal = sigtimedwait(&watched_, nullptr, &kLookEvery);
    if (signal < 0) continue;
    if (signal == SIGHUP && on_hangup_) {
      on_hangup_();
    } else if (!signalled_.stop_requested()) {
      asked_at = steady_clock::now();
      signalled_.request_stop();
    } else if (steady_clock::now() - asked_at > kSameRequest) {
      static_cast<void>(::write(STDERR_FILENO, kFarewell.data(), kFarewell.size()));
      pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
      ::raise(signal);
    }
  }
}

}  // namespace swiftlet
