// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/tcpq_conversation.hpp"

#include <optional>
#include <utility>

namespace swiftlet {
namespace {

// LCM 1.3.1, lcm_tcpq.c: all numbers are four bytes, the highest first.
constexpr std::uint32_t kClientsGreeting = 0x287617FB;
constexpr std::uint32_t kServersGreeting = 0x287617FA;
constexpr std::uint32_t kProtocolVersion = 0x0100;
constexpr std::uint32_t kPublish = 1;
constexpr std::uint32_t kSubscribe = 2;
constexpr std::uint32_t kUnsubscribe = 3;
constexpr std::size_t kNumberBytes = 4;

void append_number(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// Reads numbers and byte strings from what has come so far.
class Stream {
 public:
  explicit Stream(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> number() {
    if (bytes_.size() - at_ < kNumberBytes) return std::nullopt;
    std::uint32_t number = 0;
    for (const std::uint8_t byte : bytes_.subspan(at_, kNumberBytes)) number = number << 8U | byte;
    at_ += kNumberBytes;
    return number;
  }
  /// So many bytes behind their number, which is_too_long() if there cannot be as many.
  std::optional<std::span<const std::uint8_t>> counted() {
    const std::optional<std::uint32_t> size = number();
    is_too_long_ = is_too_long_ || (size && *size > TcpqConversation::kMaxMessageBytes);
    if (!size || is_too_long_ || bytes_.size() - at_ < *size) return std::nullopt;
    at_ += *size;
    return bytes_.subspan(at_ - *size, *size);
  }
  [[nodiscard]] bool is_too_long() const { return is_too_long_; }
  [[nodiscard]] std::ptrdiff_t read() const { return static_cast<std::ptrdiff_t>(at_); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool is_too_long_ = false;
};

}  // namespace

bool TcpqConversation::receive(std::span<const std::uint8_t> bytes) {
  received_.insert(received_.end(), bytes.begin(), bytes.end());
  Part part = Part::kDone;
  while (part == Part::kDone) part = is_greeted_ ? read_message() : read_greeting();
  return part != Part::kFaulty;
}

std::vector<std::uint8_t> TcpqConversation::take_answer() { return std::exchange(answer_, {}); }

TcpqConversation::Part TcpqConversation::read_greeting() {
  Stream stream(received_);
  const auto greeting = stream.number();
  if (greeting && *greeting != kClientsGreeting) return Part::kFaulty;
  if (!stream.number()) return Part::kIncomplete;  // the client's version: it compares ours
  append_number(answer_, kServersGreeting);
  append_number(answer_, kProtocolVersion);
  received_.erase(received_.begin(), received_.begin() + stream.read());
  is_greeted_ = true;
  return Part::kDone;
}

TcpqConversation::Part TcpqConversation::read_message() {
  Stream stream(received_);
  const auto kind = stream.number();
  if (!kind) return Part::kIncomplete;
  if (*kind != kPublish && *kind != kSubscribe && *kind != kUnsubscribe) return Part::kFaulty;
  const auto channel = stream.counted();
  const auto message = channel && *kind == kPublish ? stream.counted() : channel;
  if (stream.is_too_long()) return Part::kFaulty;
  if (!message) return Part::kIncomplete;
  const auto* const name = reinterpret_cast<const char*>(channel->data());
  if (*kind == kPublish) listener_({name, channel->size()}, *message);
  received_.erase(received_.begin(), received_.begin() + stream.read());
  return Part::kDone;
}

}  // namespace swiftlet
