// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace swiftlet {

/// Carries the newest value from one writer thread to one reader thread: older ones are overwritten unseen.
/// Wait-free on both sides, no heap. A triple buffer: writer and reader each own one slot, the third is
/// exchanged between them, so neither ever sees a value half written.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Writer thread only.
  void store(const T& value) noexcept {
    slots_[write_slot_] = value;
    const std::uint8_t previous =
        shared_.exchange(static_cast<std::uint8_t>(write_slot_ | kFresh), std::memory_order_acq_rel);
    write_slot_ = previous & kSlotMask;
  }
  /// Reader thread only. True, and `value` written, when something new was stored since the last call.
  [[nodiscard]] bool load_if_new(T& value) noexcept {
    if ((shared_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    const std::uint8_t previous = shared_.exchange(read_slot_, std::memory_order_acq_rel);
    read_slot_ = previous & kSlotMask;
    value = slots_[read_slot_];
    return true;
  }

 private:
  static constexpr std::uint8_t kSlotMask = 0x3;
  static constexpr std::uint8_t kFresh = 0x4;
  std::array<T, 3> slots_{};
  alignas(64) std::atomic<std::uint8_t> shared_{0};
  alignas(64) std::uint8_t write_slot_ = 1;
  alignas(64) std::uint8_t read_slot_ = 2;
};

}  // namespace swiftlet
