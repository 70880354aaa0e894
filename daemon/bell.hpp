// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace swiftlet {

/// Wakes a thread that sleeps: one rings, one waits. Neither takes a lock; ringing costs a system call only
/// when someone sleeps. Who waits notes strokes(), looks whether there is work, and waits from that count on:
/// no stroke in between is missed.
class Bell {
 public:
  [[nodiscard]] std::uint32_t strokes() const noexcept { return strokes_.load(std::memory_order_acquire); }
  void ring() noexcept;
  /// Sleeps until strokes() is another than `heard`, or until `wake_at`; may wake early.
  void wait(std::uint32_t heard,
            std::optional<std::chrono::steady_clock::time_point> wake_at = std::nullopt) noexcept;

 private:
  std::atomic<std::uint32_t> strokes_{0};
  std::atomic<std::uint32_t> sleepers_{0};
};

}  // namespace swiftlet
