// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>

#include "core/base/result.hpp"
#include "daemon/view/message_mailbox.hpp"
#include "daemon/view/view_service.hpp"

namespace swiftlet {

/// The page of a run, served by the program that makes it: takes the messages where they are published. Its
/// two threads (`view` serves, `view-reader` reads) yield to all others and never hold up the publisher,
/// which drops what they do not take in time. What fails in them ends the page, not the program.
class LiveView {
 public:
  /// `channel_prefix` is that of the messages. Errors: as ViewService::open.
  [[nodiscard]] static Result<std::unique_ptr<LiveView>> open(const ListenAddress& address,
                                                              const ShownSource& source,
                                                              std::string channel_prefix);
  /// What waits is still read, and pages that are open get a moment to take it.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// A message as it is published. Wait-free; allocates nothing. The publisher's thread alone.
  void take(std::string_view channel, std::span<const std::uint8_t> message) noexcept;

  [[nodiscard]] const WebServer& server() const { return service_->server(); }
  /// Any thread, with its mutex.
  [[nodiscard]] SharedRunHistory& shared() { return service_->shared(); }
  /// Messages that were not taken in time. Any thread.
  [[nodiscard]] std::uint64_t dropped() const { return mailbox_.dropped(); }

 private:
  LiveView(std::unique_ptr<ViewService> service, std::string channel_prefix);

  std::unique_ptr<ViewService> service_;
  std::string channel_prefix_;
  MessageMailbox mailbox_;
  std::jthread reader_;

  void read(const std::stop_token& stop);
};

}  // namespace swiftlet
