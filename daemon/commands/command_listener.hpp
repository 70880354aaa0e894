// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/result.hpp"
#include "daemon/workers/command.hpp"

namespace swiftlet {

/// Receives commands from programs on this machine: listens on a loopback address for LCM's tcpq://, on a
/// thread of its own (`commands`).
class CommandListener {
 public:
  /// Called by the thread. What it returns says whether the command was taken.
  using Sink = std::function<bool(const Command&)>;
  /// One more ends the one that was silent longest, after a second at least.
  static constexpr std::size_t kMaxConnections = 8;

  /// `address`: 127.0.0.1:8450. `channel`: of the commands. Error: kInvalidInput: it is no loopback address
  /// and port, or another program has it.
  [[nodiscard]] static Result<std::unique_ptr<CommandListener>> open(std::string_view address,
                                                                     std::string channel);
  ~CommandListener();
  CommandListener(const CommandListener&) = delete;
  CommandListener& operator=(const CommandListener&) = delete;

  /// Until stop(), `sink` gets each command. Call once.
  void start(Sink sink);
  /// No call of the sink is made any more, none goes on.
  void stop();

  /// What an LCM program connects to.
  [[nodiscard]] std::string url() const;

 private:
  CommandListener(int socket, std::string channel) : socket_(socket), channel_(std::move(channel)) {}
  void run(const std::stop_token& stop);
  void on_message(std::string_view channel, std::span<const std::uint8_t> message);
  void warn(const std::string& why);

  int socket_;
  std::string channel_;
  Sink sink_;
  std::size_t warnings_ = 0;
  bool has_told_channel_ = false;
  std::jthread thread_;
};

}  // namespace swiftlet
