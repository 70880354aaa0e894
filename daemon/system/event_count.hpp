// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace swiftlet {

/// Wakes a thread that sleeps: one rings, one waits. Neither takes a lock; ringing costs a system call only
/// when someone sleeps. Who waits notes epoch(), looks whether there is work, and waits from that count on:
/// no stroke in between is missed.
class EventCount {
 public:
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_.load(std::memory_order_acquire); }
  void notify() noexcept;
  /// Sleeps until epoch() is another than `epoch`, or until `wake_at`; may wake early.
  void wait(std::uint32_t epoch,
            std::optional<std::chrono::steady_clock::time_point> wake_at = std::nullopt) noexcept;

 private:
  std::atomic<std::uint32_t> epoch_{0};
  std::atomic<std::uint32_t> sleepers_{0};
};

}  // namespace swiftlet
