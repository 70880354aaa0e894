// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/python/message_listener.hpp"

#include <utility>

#include "daemon/publish/channel_names.hpp"
#include "daemon/publish/decoded_message.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxWalls = 100'000;  // more is no building

}  // namespace

template <typename Message>
void MessageListener::take(std::span<const std::uint8_t> bytes) {
  if (std::optional<Message> message = decoded_message<Message>(bytes))
    received_.emplace_back(std::move(*message));
}

/// Whoever begins in the middle waits for the next first part.
void MessageListener::take_walls(std::span<const std::uint8_t> bytes) {
  const std::optional<landmarks_t> part = decoded_message<landmarks_t>(bytes);
  if (!part) return;
  if (part->first == 0) walls_ = {.utime = part->utime, .map_id = part->map_id, .walls = {}};
  const bool is_next = part->map_id == walls_.map_id && part->first >= 0 &&
                       static_cast<std::size_t>(part->first) == walls_.walls.size();
  if (!is_next || walls_.walls.size() > kMaxWalls) return;
  walls_.walls.insert(walls_.walls.end(), part->landmarks.begin(), part->landmarks.end());
  if (walls_.walls.size() == static_cast<std::size_t>(part->total)) received_.emplace_back(walls_);
}

/// Empty for a channel that is none of swiftletd's.
LcmTransport::Listener MessageListener::taker(MessageListener* self, std::string_view channel) {
  using Bytes = std::span<const std::uint8_t>;
  if (channel == kPoseChannel || channel == kPoseLocalChannel || channel == kPoseOdomChannel)
    return [self](Bytes bytes) { self->take<pose_t>(bytes); };
  if (channel == kRangesChannel) return [self](Bytes bytes) { self->take<ranges_t>(bytes); };
  if (channel == kMapTileChannel) return [self](Bytes bytes) { self->take<map_tile_t>(bytes); };
  if (channel == kLandmarksChannel) return [self](Bytes bytes) { self->take_walls(bytes); };
  if (channel == kLoopClosureChannel) return [self](Bytes bytes) { self->take<loop_closure_t>(bytes); };
  if (channel == kVehicleEventChannel) return [self](Bytes bytes) { self->take<vehicle_event_t>(bytes); };
  if (channel == kStatusChannel) return [self](Bytes bytes) { self->take<status_t>(bytes); };
  return {};
}

Result<std::unique_ptr<MessageListener>> MessageListener::open(const std::string& url,
                                                               const std::string& channel_prefix,
                                                               std::span<const std::string> channels) {
  Result<std::unique_ptr<LcmTransport>> transport = LcmTransport::open(url);
  if (!transport) return transport.error();
  std::unique_ptr<MessageListener> listener(new MessageListener(std::move(transport).value()));
  for (const std::string& channel : channels) {
    LcmTransport::Listener take = taker(listener.get(), channel);
    if (!take) return Error{ErrorCode::kInvalidInput, "no channel \"" + channel + "\" of messages"};
    listener->transport_->listen(channel_prefix + channel, std::move(take));
  }
  return listener;
}

std::optional<DaemonMessage> MessageListener::receive(Duration timeout) {
  if (received_.empty()) transport_->receive(timeout);
  if (received_.empty()) return std::nullopt;
  DaemonMessage message = std::move(received_.front());
  received_.pop_front();
  return message;
}

}  // namespace swiftlet
