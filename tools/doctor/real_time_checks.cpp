// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/real_time_checks.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

namespace swiftlet {
namespace {

constexpr unsigned kCapIpcLock = 14;
constexpr unsigned kCapSysNice = 23;
constexpr const char* kNotNeeded = "; swiftletd runs without, later under load";
constexpr const char* kHowToGrant =
    "to grant it: '@plugdev - rtprio 80' and '@plugdev - memlock unlimited' in "
    "/etc/security/limits.d/swiftlet.conf, "
    "log in again";

bool has_capability(const SystemFiles& files, unsigned capability) {
  const std::string status = files.read("/proc/self/status").value_or("");
  const std::string mask = field_of(status, "CapEff:").value_or("0");
  std::uint64_t bits = 0;
  std::from_chars(mask.data(), mask.data() + mask.size(), bits, 16);
  return ((bits >> capability) & 1U) != 0;
}

/// The soft limit as the kernel writes it: a number or "unlimited".
std::optional<std::string> limit_of(const SystemFiles& files, const std::string& name) {
  const std::string limits = files.read("/proc/self/limits").value_or("");
  const std::optional<std::string> values = field_of(limits, name);
  return values ? std::optional(values->substr(0, values->find(' '))) : std::nullopt;
}

std::string kernel_text(const SystemFiles& files) {
  const bool is_real_time = files.read_number("/sys/kernel/realtime") == 1 ||
                            files.read("/proc/version").value_or("").find("PREEMPT_RT") != std::string::npos;
  return is_real_time ? "a PREEMPT_RT kernel" : "an ordinary kernel";
}

Finding check_priority(const SystemFiles& files) {
  const std::string limit = limit_of(files, "Max realtime priority").value_or("0");
  const std::string kernel = kernel_text(files);
  if (has_capability(files, kCapSysNice))
    return {Mark::kOk, "real time", "real-time priority granted by CAP_SYS_NICE, " + kernel, ""};
  if (limit != "0")
    return {Mark::kOk, "real time", "real-time priority granted up to " + limit + ", " + kernel, ""};
  return {Mark::kOk, "real time", "no real-time priority (RLIMIT_RTPRIO 0), " + kernel + kNotNeeded,
          kHowToGrant};
}

Finding check_memory_lock(const SystemFiles& files) {
  if (has_capability(files, kCapIpcLock))
    return {Mark::kOk, "memory lock", "memory may be locked: CAP_IPC_LOCK", ""};
  const std::string limit = limit_of(files, "Max locked memory").value_or("0");
  if (limit == "unlimited") return {Mark::kOk, "memory lock", "memory may be locked without limit", ""};
  return {Mark::kOk, "memory lock",
          "no memory is locked within a limit (RLIMIT_MEMLOCK " + limit + ")" + kNotNeeded, kHowToGrant};
}

}  // namespace

Findings check_real_time(const SystemFiles& files) {
  return {check_priority(files), check_memory_lock(files)};
}

}  // namespace swiftlet
