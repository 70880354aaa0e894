// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <pthread.h>

#include "core/base/result.hpp"

namespace swiftlet {

// All that is asked of the system for the sake of time. Each may be refused; the daemon then runs on without.

struct ThreadSetup {
  int fifo_priority = 0;  ///< SCHED_FIFO, 1 to 99; 0: scheduled like any other program
  int cpu = -1;           ///< the only processor it runs on; -1: any
};

/// Of a running thread, by any other. Error: kInvalidInput: refused; the message has what and why in a few
/// words.
[[nodiscard]] Status set_up_thread(pthread_t thread, const ThreadSetup& setup);

/// What is mapped now is read in and stays in memory, what comes later stays once it is touched. Error: as
/// above; also where a limit (RLIMIT_MEMLOCK) holds for this process.
[[nodiscard]] Status lock_memory();

/// Memory that is freed stays with the process, in place of going back to the system and coming again page by
/// page, zeroed: of blocks below 4 MiB, and up to 32 MiB at the end of each heap. (On machines of 32 bits the
/// heaps of threads are too small for that.) For the start of a program, before its threads.
void keep_freed_memory() noexcept;

/// The calling thread, scheduled like any other program, runs after those of the same kind: its share of a
/// busy processor is a tenth of theirs.
void yield_to_others() noexcept;

/// Touches the next 256 kB of the calling thread's stack, several times what radio, frontend and publisher
/// need, so that no page of it is missing later.
void prefault_stack() noexcept;

}  // namespace swiftlet
