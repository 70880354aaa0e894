// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_transport.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <list>
#include <string_view>
#include <utility>

namespace swiftlet {
namespace {

/// LCM itself answers an unknown provider with two lines on stderr and no reason.
bool has_known_provider(std::string_view url) {
  constexpr std::array<std::string_view, 4> kProviders{"udpm://", "file://", "tcpq://", "memq://"};
  return std::any_of(kProviders.begin(), kProviders.end(),
                     [&](std::string_view provider) { return url.substr(0, provider.size()) == provider; });
}

struct Channel {
  LcmTransport::Listener listener;

  // No method: GCC 12's sanitizer takes LCM's calls of those for wild ones.
  static void take(const lcm::ReceiveBuffer* message, const std::string& /*channel*/, Channel* self) {
    self->listener({static_cast<const std::uint8_t*>(message->data), message->data_size});
  }
};

}  // namespace

struct LcmTransport::State {
  explicit State(const std::string& url) : lcm(url) {}
  std::list<Channel> channels;  // LCM keeps their addresses
  lcm::LCM lcm;
};

Result<std::unique_ptr<LcmTransport>> LcmTransport::open(const std::string& url) {
  if (!has_known_provider(url))
    return Error{ErrorCode::kInvalidInput,
                 "LCM URL \"" + url + "\": must begin with udpm://, file://, tcpq:// or memq://"};
  auto state = std::make_unique<State>(url);
  if (!state->lcm.good())
    return Error{ErrorCode::kInvalidInput,
                 "LCM URL \"" + url + "\": LCM could not open it; swiftlet doctor says why"};
  return std::unique_ptr<LcmTransport>(new LcmTransport(std::move(state)));
}

LcmTransport::LcmTransport(std::unique_ptr<State> state) : state_(std::move(state)) {}
LcmTransport::~LcmTransport() = default;

bool LcmTransport::publish(const std::string& channel, std::span<const std::uint8_t> message) {
  return state_->lcm.publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0;
}

void LcmTransport::listen(const std::string& channel, Listener listener) {
  Channel& kept = state_->channels.emplace_back(Channel{std::move(listener)});
  state_->lcm.subscribeFunction(channel, &Channel::take, &kept);
}

bool LcmTransport::receive(Duration timeout) {
  const auto timeout_ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
  return state_->lcm.handleTimeout(static_cast<int>(timeout_ms)) > 0;
}

}  // namespace swiftlet
