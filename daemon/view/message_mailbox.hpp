// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace swiftlet {

/// Messages on their way from the thread that publishes to one that reads them when it can. Of fixed size,
/// without locks: the writer never waits. One thread may write and one may read.
class MessageMailbox {
 public:
  explicit MessageMailbox(std::size_t bytes) : ring_(bytes) {}

  /// Where there is no room, the message is dropped and counted. Wait-free; allocates nothing.
  void put(std::uint32_t channel, std::span<const std::uint8_t> message) noexcept;

  struct Message {
    std::uint32_t channel = 0;
    std::vector<std::uint8_t> bytes;
  };
  /// The oldest; false: there is none. `message` is kept from call to call for its storage.
  [[nodiscard]] bool take(Message& message);

  /// Any thread.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  struct Head {
    std::uint32_t channel = 0;
    std::uint32_t bytes = 0;
  };
  boost::lockfree::spsc_queue<std::uint8_t> ring_;
  std::optional<Head> head_;  // the reader's: of a message whose bytes are still being written
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace swiftlet
