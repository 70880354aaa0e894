// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swiftlet {

/// One message to whoever is at the other end of a WebSocket.
struct WebMessage {
  bool is_text = true;
  std::string bytes;
};

/// What a WebSocket carries, without the WebSocket. The server asks for the next message only when the one
/// before has left: a slow reader gets the newest state and costs no memory. The server's thread alone.
class Conversation {
 public:
  Conversation() = default;
  virtual ~Conversation() = default;
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  /// What is to be sent now; nullopt: nothing new.
  [[nodiscard]] virtual std::optional<WebMessage> next() = 0;
  /// A text message from the other end; anything may be in it.
  virtual void take(std::string_view text) = 0;
};

}  // namespace swiftlet
