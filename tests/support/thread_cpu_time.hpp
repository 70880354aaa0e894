// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <ctime>

#include "core/base/check.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// What the calling thread has used of a core so far.
inline Duration thread_cpu_time() {
  timespec time{};
  SWIFTLET_CHECK(::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0, "Linux knows a thread's CPU time");
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace swiftlet
