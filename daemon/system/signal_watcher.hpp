// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <csignal>
#include <functional>
#include <stop_token>
#include <thread>

namespace swiftlet {

/// Turns the first SIGINT, SIGTERM or SIGHUP into a request to stop; SIGHUP into a call instead, where one is
/// given, and into nothing where the program began with SIGHUP ignored. A second request, unless it comes
/// within a second (timeout(1) and some terminals send each twice), ends the program at once, as it would
/// have without the watcher, and with a line on stderr. Make it before any other thread: it blocks the
/// signals in the calling thread, and threads inherit that.
class SignalWatcher {
 public:
  /// `on_hangup` is called by the watcher's own thread.
  explicit SignalWatcher(std::function<void()> on_hangup = {});
  ~SignalWatcher();
  SignalWatcher(const SignalWatcher&) = delete;
  SignalWatcher& operator=(const SignalWatcher&) = delete;

  /// Requested when a signal came.
  [[nodiscard]] std::stop_token token() const { return signalled_.get_token(); }

 private:
  sigset_t watched_{};
  sigset_t previous_{};
  std::function<void()> on_hangup_;
  std::stop_source signalled_;
  std::jthread thread_;

  void watch(const std::stop_token& over);
};

}  // namespace swiftlet
