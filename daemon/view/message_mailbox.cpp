// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/message_mailbox.hpp"

#include <array>
#include <cstring>

namespace swiftlet {

void MessageMailbox::put(std::uint32_t channel, std::span<const std::uint8_t> message) noexcept {
  const Head head{.channel = channel, .bytes = static_cast<std::uint32_t>(message.size())};
  if (ring_.write_available() < sizeof head + message.size()) {
    dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return;
  }
  std::array<std::uint8_t, sizeof head> raw;
  std::memcpy(raw.data(), &head, sizeof head);
  ring_.push(raw.data(), raw.size());
  ring_.push(message.data(), message.size());
}

bool MessageMailbox::take(Message& message) {
  if (!head_) {
    std::array<std::uint8_t, sizeof(Head)> raw;
    if (ring_.read_available() < raw.size()) return false;
    ring_.pop(raw.data(), raw.size());
    Head head;
    std::memcpy(&head, raw.data(), raw.size());
    head_ = head;
  }
  if (ring_.read_available() < head_->bytes) return false;
  message.channel = head_->channel;
  message.bytes.resize(head_->bytes);
  ring_.pop(message.bytes.data(), message.bytes.size());
  head_.reset();
  return true;
}

}  // namespace swiftlet
