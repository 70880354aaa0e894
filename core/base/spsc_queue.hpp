// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace swiftlet {

/// A queue of fixed capacity between one writer thread and one reader thread, without locks and without heap
/// after construction. Each end is a type of its own, so that a worker can use one end only. A full queue
/// refuses the newest item and counts it. The queue must outlive both ends.
template <typename T, std::size_t kCapacity>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "queue elements are plain structs");

 public:
  class Producer {
   public:
    /// False when full: the item is refused and counted. Wait-free.
    [[nodiscard]] bool try_push(const T& item) noexcept { return queue_->push(item); }
    /// Whether the next try_push will succeed. Wait-free.
    [[nodiscard]] bool has_room() const noexcept { return queue_->ring_.write_available() > 0; }

   private:
    friend class SpscQueue;
    explicit Producer(SpscQueue* queue) : queue_(queue) {}
    SpscQueue* queue_;
  };
  class Consumer {
   public:
    /// False when empty. Wait-free.
    [[nodiscard]] bool try_pop(T& item) noexcept { return queue_->ring_.pop(item); }
    [[nodiscard]] std::size_t size() const noexcept { return queue_->ring_.read_available(); }

   private:
    friend class SpscQueue;
    explicit Consumer(SpscQueue* queue) : queue_(queue) {}
    SpscQueue* queue_;
  };

  SpscQueue() = default;
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  Producer producer() noexcept { return Producer(this); }
  Consumer consumer() noexcept { return Consumer(this); }

  static constexpr std::size_t capacity() { return kCapacity; }
  /// Any thread.
  [[nodiscard]] std::uint64_t rejected_count() const noexcept {
    return rejected_.load(std::memory_order_relaxed);
  }
  /// The most items that ever waited. Any thread.
  [[nodiscard]] std::uint64_t high_water() const noexcept {
    return high_water_.load(std::memory_order_relaxed);
  }

 private:
  bool push(const T& item) noexcept {
    if (!ring_.push(item)) {
      rejected_.store(rejected_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    const std::uint64_t waiting = kCapacity - ring_.write_available();
    if (waiting > high_water_.load(std::memory_order_relaxed))
      high_water_.store(waiting, std::memory_order_relaxed);
    return true;
  }

  boost::lockfree::spsc_queue<T, boost::lockfree::capacity<kCapacity>> ring_;
  std::atomic<std::uint64_t> rejected_{0};    // written by the producer only
  std::atomic<std::uint64_t> high_water_{0};  // written by the producer only
};

}  // namespace swiftlet
