// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/thread_setup.hpp"

#include <linux/capability.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>

namespace swiftlet {
namespace {

constexpr std::size_t kTouchedStack = std::size_t{256} * 1024;
constexpr std::size_t kPage = 4096;

Error refused(const std::string& what, int why) {
  return {ErrorCode::kInvalidInput, what + ": " + std::strerror(why)};
}

bool may_lock_without_limit() {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> capabilities{};
  return ::syscall(SYS_capget, &header, capabilities.data()) == 0 &&
         (capabilities[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

}  // namespace

Status set_up_thread(pthread_t thread, const ThreadSetup& setup) {
  if (setup.cpu >= 0) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(static_cast<std::size_t>(setup.cpu), &cpus);
    const int failure = pthread_setaffinity_np(thread, sizeof cpus, &cpus);
    if (failure != 0) return refused("processor " + std::to_string(setup.cpu), failure);
  }
  if (setup.fifo_priority > 0) {
    sched_param priority{};
    priority.sched_priority = setup.fifo_priority;
    const int failure = pthread_setschedparam(thread, SCHED_FIFO, &priority);
    if (failure != 0) return refused("SCHED_FIFO priority " + std::to_string(setup.fifo_priority), failure);
  }
  return {};
}

/// Not within a limit: what is mapped later, stacks too, could not be had beyond it.
Status lock_memory() {
  rlimit limit{};
  const bool is_limited = ::getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
  if (is_limited && !may_lock_without_limit()) return refused("locked memory", EPERM);
  if (::mlockall(MCL_CURRENT) != 0) return refused("locked memory", errno);
  // Whole stacks of threads to come would be read in without this.
  if (::mlockall(MCL_FUTURE | MCL_ONFAULT) != 0) return refused("locked memory", errno);
  return {};
}

void keep_freed_memory() noexcept {
  constexpr int kMiB = 1024 * 1024;
  // By default both limits follow the largest block that was freed, and go up to 32 and 64 MiB, from 128 KiB.
  // Larger blocks than this are mapped one by one, so that they leave no holes behind.
  static_cast<void>(::mallopt(M_MMAP_THRESHOLD, 4 * kMiB));
  static_cast<void>(::mallopt(M_TRIM_THRESHOLD, 32 * kMiB));
}

void yield_to_others() noexcept {
  constexpr int kNiceness = 10;
  static_cast<void>(
      ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness));  // lowering is allowed
}

void prefault_stack() noexcept {
  std::array<std::byte, kTouchedStack> room;  // NOLINT(cppcoreguidelines-pro-type-member-init): touched below
  volatile std::byte* const bytes = room.data();
  for (std::size_t i = 0; i < kTouchedStack; i += kPage) bytes[i] = std::byte{0};
}

}  // namespace swiftlet
