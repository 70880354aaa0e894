// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/base/spsc_queue.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/system/event_count.hpp"

namespace swiftlet {

/// A queue between two workers: an SpscQueue with a word for "nothing more will come" and a event_count by
/// which the consumer's thread sleeps without spinning. Neither end takes a lock. The queue must outlive both
/// ends.
template <typename T, std::size_t kCapacity>
class StageQueue {
 public:
  class Producer {
   public:
    /// False when full: the item is refused and counted.
    [[nodiscard]] bool try_push(const T& item) noexcept {
      if (!end_.try_push(item)) return false;
      queue_->event_count_.notify();
      return true;
    }
    [[nodiscard]] bool has_room() const noexcept { return end_.has_room(); }
    /// Nothing more will be pushed. May be called twice.
    void close() noexcept {
      queue_->closed_.store(true, std::memory_order_release);
      queue_->event_count_.notify();
    }

   private:
    friend class StageQueue;
    explicit Producer(StageQueue* queue) : queue_(queue), end_(queue->ring_buffer_.producer()) {}
    StageQueue* queue_;
    typename SpscQueue<T, kCapacity>::Producer end_;
  };

  class Consumer {
   public:
    /// False when nothing waits.
    [[nodiscard]] bool try_pop(T& item) noexcept { return end_.try_pop(item); }
    /// Ask before try_pop: an empty queue that was closed before the look stays empty.
    [[nodiscard]] bool closed() const noexcept { return queue_->closed_.load(std::memory_order_acquire); }
    /// Sleeps until something waits or the queue is closed.
    void wait() const noexcept {
      wait_unless([] { return false; });
    }
    /// The same; does not sleep where `has_other_work`, for which wake() wakes it.
    template <typename OtherWork>
    void wait_unless(OtherWork has_other_work) const noexcept {
      const std::uint32_t epoch = queue_->event_count_.epoch();
      if (end_.size() > 0 || closed() || has_other_work()) return;
      queue_->event_count_.wait(epoch);
    }
    /// Sleeps until something waits, the queue is closed, or `wake_at`. Whether something waits.
    [[nodiscard]] bool wait_until(Clock& clock, MonotonicTime wake_at) const {
      const std::uint32_t epoch = queue_->event_count_.epoch();
      if (end_.size() == 0 && !closed()) clock.wait_for(queue_->event_count_, epoch, wake_at);
      return end_.size() > 0;
    }

   private:
    friend class StageQueue;
    explicit Consumer(StageQueue* queue) : queue_(queue), end_(queue->ring_buffer_.consumer()) {}
    StageQueue* queue_;
    typename SpscQueue<T, kCapacity>::Consumer end_;
  };

  Producer producer() noexcept { return Producer(this); }
  Consumer consumer() noexcept { return Consumer(this); }

  /// Wakes the consumer as if something had come. Any thread.
  void wake() noexcept { event_count_.notify(); }

  static constexpr std::size_t capacity() { return kCapacity; }
  /// Any thread.
  [[nodiscard]] std::uint64_t rejected_count() const noexcept { return ring_buffer_.rejected_count(); }
  /// The most items that ever waited. Any thread.
  [[nodiscard]] std::uint64_t high_water() const noexcept { return ring_buffer_.high_water(); }

 private:
  SpscQueue<T, kCapacity> ring_buffer_;
  std::atomic<bool> closed_{false};
  EventCount event_count_;
};

}  // namespace swiftlet
