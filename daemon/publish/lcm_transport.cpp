// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_transport.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <list>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "daemon/publish/lcm_network.hpp"
#include "daemon/publish/lcm_url.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kLogEventBytes = 28;  // of each message in a log, beside channel and content
constexpr int kWaitingMessages = 1000;      // of a channel; LCM's own 30 are fewer than tiles come at once

/// How long a server of tcpq:// may take or give not a byte. LCM waits again after some bytes: a stalled
/// server holds a thread up for some times as long; the service's watchdog waits for 10 s.
constexpr timeval kServerWait{.tv_sec = 0, .tv_usec = 500'000};

/// LCM closes a socket that waited for longer. False: there is none.
bool limit_waits(int socket) {
  return ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &kServerWait, sizeof kServerWait) == 0 &&
         ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &kServerWait, sizeof kServerWait) == 0;
}

/// 0 of what has no size.
std::uintmax_t size_of(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(file, failure);
  return failure ? 0 : bytes;
}

}  // namespace

struct LcmTransport::State {
  struct Channel {
    std::string name;
    LcmTransport::Listener listener;

    // No method: GCC 12's sanitizer takes LCM's calls of those for wild ones.
    static void take(const lcm::ReceiveBuffer* message, const std::string& /*channel*/, Channel* self) {
      self->listener({static_cast<const std::uint8_t*>(message->data), message->data_size});
    }
  };

  State(const std::string& of_url, Duration patience, std::string file)
      : url(of_url), server(LcmServer::of_url(of_url, patience)), log(std::move(file)) {}

  /// nullptr while the server of tcpq:// is absent, or LCM cannot use the URL.
  lcm::LCM* connected() {
    if (lcm && has_lost_server()) disconnect();
    if (lcm) return &*lcm;
    if (server && !server->is_there()) return nullptr;
    lcm.emplace(server ? server->numeric_url() : url);
    if (!lcm->good() || (server && !limit_waits(lcm->getFileno()))) disconnect();
    if (!lcm) return nullptr;
    for (Channel& channel : channels) subscribe(channel);
    return &*lcm;
  }
  /// LCM has closed its socket, after part of a message too, and would connect anew by itself, without limit.
  bool has_lost_server() { return server && lcm->getFileno() < 0; }
  void subscribe(Channel& channel) {
    if (has_lost_server()) return;  // the next connection subscribes all
    lcm::Subscription* const subscription = lcm->subscribeFunction(channel.name, &Channel::take, &channel);
    if (subscription != nullptr) subscription->setQueueCapacity(kWaitingMessages);
  }
  void disconnect() {
    lcm.reset();
    if (server) server->mark_lost();
  }

  std::string url;
  std::optional<LcmServer> server;
  std::list<Channel> channels;  // LCM keeps their addresses
  std::optional<lcm::LCM> lcm;
  bool has_ended = false;
  std::filesystem::path log;     // of file://
  std::uintmax_t log_bytes = 0;  // that it has when all of it is on the disk
};

Result<std::unique_ptr<LcmTransport>> LcmTransport::open(const std::string& url, Duration patience) {
  const Result<LcmUrl> parsed = parse_lcm_url(url);
  if (!parsed) return parsed.error();
  const bool is_multicast = parsed->provider == LcmUrl::Provider::kMulticast;
  if (is_multicast && !has_route_to(parsed->group))
    return Error{ErrorCode::kInvalidInput,
                 "LCM URL \"" + url + "\": no route to " + parsed->group +
                     " on this machine's network; keep it within the machine: " + kRouteOverLoopback};
  auto state = std::make_unique<State>(url, patience, parsed->file);
  if (state->server && !state->server->is_there()) state->server->wait_for_look();
  if (state->connected() == nullptr && !state->server)
    return Error{ErrorCode::kInvalidInput, "LCM URL \"" + url + "\": LCM could not open it" +
                                               (is_multicast ? "; swiftlet doctor finds the reason" : "")};
  state->log_bytes = size_of(state->log);
  return std::unique_ptr<LcmTransport>(new LcmTransport(std::move(state)));
}

LcmTransport::LcmTransport(std::unique_ptr<State> state) : state_(std::move(state)) {}
LcmTransport::~LcmTransport() = default;

bool LcmTransport::publish(const std::string& channel, std::span<const std::uint8_t> message) {
  lcm::LCM* lcm = state_->connected();
  if (lcm == nullptr) {
    errno = ENOTCONN;
    return false;
  }
  const bool is_taken = lcm->publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0;
  if (!is_taken && state_->server) {
    state_->disconnect();
    errno = ENOTCONN;
  }
  if (is_taken) state_->log_bytes += kLogEventBytes + channel.size() + message.size();
  return is_taken;
}

Status LcmTransport::check_log() const {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(state_->log, ignored)) return {};
  static_cast<void>(std::fflush(nullptr));  // LCM does not hand out its file
  const std::uintmax_t bytes = size_of(state_->log);
  if (bytes >= state_->log_bytes) return {};
  return Error{ErrorCode::kOutOfSpace,
               state_->log.string() + ": the LCM log is not complete: " + std::to_string(bytes) + " of " +
                   std::to_string(state_->log_bytes) + " bytes were written; make room there"};
}

void LcmTransport::listen(const std::string& channel, Listener listener) {
  State::Channel& kept = state_->channels.emplace_back(State::Channel{channel, std::move(listener)});
  if (state_->lcm) state_->subscribe(kept);
}

bool LcmTransport::receive(Duration timeout) {
  lcm::LCM* lcm = state_->connected();
  if (lcm == nullptr) {
    std::this_thread::sleep_for(timeout);
    return false;
  }
  const auto timeout_ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
  errno = 0;
  const int handled = lcm->handleTimeout(static_cast<int>(timeout_ms));
  if (handled < 0 && state_->server) state_->disconnect();
  if (handled < 0 && errno != EINTR && state_->url.starts_with("file://")) state_->has_ended = true;
  return handled > 0;
}

bool LcmTransport::has_ended() const { return state_->has_ended; }

}  // namespace swiftlet
