// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace swiftlet {

/// The server's side of a connection by LCM's tcpq:// that takes messages and gives none. Has no socket. One
/// thread at a time.
class TcpqConversation {
 public:
  /// Both are valid during the call.
  using Listener = std::function<void(std::string_view channel, std::span<const std::uint8_t> message)>;

  /// More bytes than any message for this server has.
  static constexpr std::size_t kMaxMessageBytes = 1000;

  explicit TcpqConversation(Listener listener) : listener_(std::move(listener)) {}

  /// The next bytes of the stream. False: they are not LCM's, or too many for a message.
  [[nodiscard]] bool receive(std::span<const std::uint8_t> bytes);
  /// Bytes for the client since the last call.
  [[nodiscard]] std::vector<std::uint8_t> take_answer();

 private:
  enum class Part : std::uint8_t { kIncomplete, kDone, kFaulty };
  [[nodiscard]] Part read_greeting();
  [[nodiscard]] Part read_message();

  Listener listener_;
  bool is_greeted_ = false;
  std::vector<std::uint8_t> received_;  // not yet read
  std::vector<std::uint8_t> answer_;
};

}  // namespace swiftlet
