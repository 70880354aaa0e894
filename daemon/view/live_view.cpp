// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/live_view.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

#include "daemon/system/thread_setup.hpp"
#include "daemon/view/message_reader.hpp"

namespace swiftlet {
namespace {

/// A second of the fastest publishing: tiles at 4 MB/s.
constexpr std::size_t kMailboxBytes = 4'000'000;
constexpr std::chrono::milliseconds kTick{20};
constexpr std::chrono::milliseconds kLastMoment{200};

}  // namespace

Result<std::unique_ptr<LiveView>> LiveView::open(const ListenAddress& address, const ShownSource& source,
                                                 std::string channel_prefix) {
  Result<std::unique_ptr<ViewService>> service = ViewService::open(address, source, {});
  if (!service) return service.error();
  return std::unique_ptr<LiveView>(new LiveView(std::move(service).value(), std::move(channel_prefix)));
}

LiveView::LiveView(std::unique_ptr<ViewService> service, std::string channel_prefix)
    : service_(std::move(service)),
      channel_prefix_(std::move(channel_prefix)),
      mailbox_(kMailboxBytes),
      reader_([this](const std::stop_token& stop) {
        yield_to_others();
        try {
          read(stop);
        } catch (const std::exception& error) {
          spdlog::error("the page of the run ends here: {}; the run goes on", error.what());
        }
      }) {
  pthread_setname_np(reader_.native_handle(), "view-reader");
}

LiveView::~LiveView() {
  reader_.request_stop();
  reader_.join();
  std::this_thread::sleep_for(kLastMoment);
}

void LiveView::take(std::string_view channel, std::span<const std::uint8_t> message) noexcept {
  if (!channel.starts_with(channel_prefix_)) return;
  channel.remove_prefix(channel_prefix_.size());
  const auto channels = viewed_channels();
  const auto found = std::find(channels.begin(), channels.end(), channel);
  if (found == channels.end()) return;
  mailbox_.put(static_cast<std::uint32_t>(found - channels.begin()), message);
}

void LiveView::read(const std::stop_token& stop) {
  SharedRunHistory& shared = service_->shared();
  MessageReader reader(shared.history);
  MessageMailbox::Message message;
  std::uint64_t dropped = 0;
  for (bool is_last = false; !is_last;) {
    is_last = stop.stop_requested();  // before the look: what came before is read
    while (mailbox_.take(message)) {
      const std::lock_guard lock(shared.mutex);
      reader.take(viewed_channels()[message.channel], message.bytes, std::chrono::steady_clock::now());
    }
    if (const std::uint64_t now = mailbox_.dropped(); dropped == 0 && now > 0) {
      dropped = now;
      spdlog::warn("the page of the run lags behind: it misses messages; the run does not wait for it");
    }
    if (!is_last) std::this_thread::sleep_for(kTick);
  }
}

}  // namespace swiftlet
