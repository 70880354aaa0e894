// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/view_service.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <exception>
#include <span>
#include <utility>

#include "daemon/publish/lcm_transport.hpp"
#include "daemon/system/thread_setup.hpp"
#include "daemon/view/foxglove_conversation.hpp"
#include "daemon/view/message_reader.hpp"
#include "daemon/view/page_files.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kLivePath = "/live";
constexpr std::chrono::milliseconds kStopWait{100};  // the longest a stop goes unnoticed

}  // namespace

Result<std::unique_ptr<ViewService>> ViewService::open(const ListenAddress& address,
                                                       const ShownSource& source,
                                                       const std::vector<std::string>& foreign_origins) {
  std::unique_ptr<ViewService> service(new ViewService(source));
  ViewService* const self = service.get();
  const auto converse = [self](const SocketRequest& wanted) -> SocketAnswer {
    const std::string_view foxglove = foxglove_subprotocol(wanted.subprotocols);
    if (!foxglove.empty())
      return {std::make_unique<FoxgloveConversation>(self->shared_, self->source_,
                                                     std::chrono::steady_clock::now),
              foxglove};
    if (wanted.path != kLivePath) return {};
    return {std::make_unique<Viewer>(self->shared_, self->source_), {}};
  };
  Result<std::unique_ptr<WebServer>> server = WebServer::open(
      address, {.files = page_files(), .converse = converse, .foreign_origins = foreign_origins});
  if (!server) return server.error();
  service->server_ = std::move(server).value();
  service->thread_ = std::jthread([self](const std::stop_token& stop) { self->serve(stop); });
  pthread_setname_np(service->thread_.native_handle(), "view");
  return service;
}

ViewService::~ViewService() = default;

void ViewService::serve(const std::stop_token& stop) {
  yield_to_others();
  try {
    server_->run(stop);
  } catch (const std::exception& error) {
    spdlog::error("the page of the run is served no more: {}", error.what());
  }
}

Status view_lcm(const std::string& url, const std::string& channel_prefix, SharedRunHistory& shared,
                const std::stop_token& stop, const std::function<void()>& after_message) {
  const Result<std::unique_ptr<LcmTransport>> lcm = LcmTransport::open(url);
  if (!lcm) return lcm.error();
  MessageReader reader(shared.history);
  for (const std::string_view channel : viewed_channels())
    (*lcm)->listen(channel_prefix + std::string(channel),
                   [&, channel](std::span<const std::uint8_t> message) {
                     const std::lock_guard lock(shared.mutex);
                     reader.take(channel, message, std::chrono::steady_clock::now());
                     if (after_message) after_message();
                   });
  while (!stop.stop_requested() && !(*lcm)->has_ended()) (*lcm)->receive(kStopWait);
  return {};
}

}  // namespace swiftlet
