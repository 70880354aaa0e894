// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_conversation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr FoxglovePace kPace{.period_us = 1'000'000, .bytes_per_s = 1e6, .max_waiting = 100};
constexpr char kMessageData = 1;
constexpr int kWarningLevel = 1;
/// The trajectory is known at the end of a run alone.
constexpr std::size_t kLiveTopics = static_cast<std::size_t>(FoxgloveTopic::kTrajectory);

// Foreign bytes (a file's name in the title) need not be UTF-8.
WebMessage text_message(const Json& content) {
  return {.is_text = true, .bytes = content.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

WebMessage server_info(const ShownSource& source) {
  return text_message(
      {{"op", "serverInfo"}, {"name", "swiftlet: " + source.title}, {"capabilities", Json::array()}});
}

WebMessage advertisement() {
  Json channels = Json::array();
  for (const FoxgloveChannel& channel : foxglove_channels().first(kLiveTopics))
    channels.push_back({{"id", channel.id},
                        {"topic", channel.topic},
                        {"encoding", kFoxgloveEncoding},
                        {"schemaName", channel.schema_name},
                        {"schemaEncoding", kFoxgloveSchemaEncoding},
                        {"schema", channel.schema}});
  return text_message({{"op", "advertise"}, {"channels", std::move(channels)}});
}

WebMessage status(const std::string& complaint) {
  return text_message({{"op", "status"}, {"level", kWarningLevel}, {"message", complaint}});
}

template <typename Number>
void append_little_endian(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
}

WebMessage data_message(std::uint32_t subscription, const FoxgloveMessage& message) {
  WebMessage data{.is_text = false, .bytes = {kMessageData}};
  append_little_endian(data.bytes, subscription);
  append_little_endian(data.bytes,
                       static_cast<std::uint64_t>(std::max<std::int64_t>(message.utime_us, 0)) * 1000);
  data.bytes += message.json;
  return data;
}

/// A member that is a whole number without a sign, of at most 32 bits.
std::optional<std::uint32_t> number_of(const Json& value) {
  constexpr std::uint64_t kMost = 0xffff'ffff;
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost) return std::nullopt;
  return static_cast<std::uint32_t>(value.get<std::uint64_t>());
}

/// The items of a member that is a list; empty where there is none.
Json list_of(const Json& message, const char* member) {
  const auto found = message.find(member);
  return found != message.end() && found->is_array() ? *found : Json::array();
}

}  // namespace

std::string_view foxglove_subprotocol(const std::vector<std::string_view>& offered) {
  for (const std::string_view spoken : kSubprotocols)
    if (std::find(offered.begin(), offered.end(), spoken) != offered.end()) return spoken;
  return {};
}

FoxgloveConversation::FoxgloveConversation(SharedRunHistory& shared, const ShownSource& source, Now now)
    : shared_(shared), source_(source), now_(std::move(now)), feed_(kPace) {}

/// Of a recording that is played; unset: the newest.
std::optional<std::int64_t> FoxgloveConversation::moment(const RunHistory& history) {
  if (!source_.is_recording) return std::nullopt;
  const std::span<const TrailPose> poses = history.poses_after(0);
  if (poses.empty() || subscriptions_.empty()) return 0;
  if (!playing_since_ || played_generation_ != history.generation()) playing_since_ = now_();
  played_generation_ = history.generation();
  const double played_us =
      source_.rate * std::chrono::duration<double, std::micro>(now_() - *playing_since_).count();
  return poses.front().utime_us + static_cast<std::int64_t>(played_us);
}

std::optional<WebMessage> FoxgloveConversation::next() {
  if (greetings_ == 0) {
    ++greetings_;
    return server_info(source_);
  }
  if (greetings_ == 1) {
    ++greetings_;
    return advertisement();
  }
  if (!complaint_.empty()) return status(std::exchange(complaint_, {}));
  const std::lock_guard lock(shared_.mutex);
  const std::optional<std::int64_t> at_us = moment(shared_.history);
  if (shared_.history.is_finished_at(at_us)) feed_.hurry();
  const std::optional<FoxgloveMessage> message = feed_.next(shared_.history, at_us);
  if (!message) return std::nullopt;
  return data_message(subscriptions_.at(message->topic), *message);
}

void FoxgloveConversation::take(std::string_view text) {
  const Json message = Json::parse(text, nullptr, false);
  const bool is_named = message.is_object() && message.contains("op") && message["op"].is_string();
  const std::string operation = is_named ? message["op"].get<std::string>() : "";
  if (operation == "subscribe") {
    for (const Json& wanted : list_of(message, "subscriptions")) {
      const auto id = wanted.is_object() ? number_of(wanted.value("id", Json())) : std::nullopt;
      const auto channel = wanted.is_object() ? number_of(wanted.value("channelId", Json())) : std::nullopt;
      if (id && channel)
        subscribe(*id, *channel);
      else
        complaint_ = "a subscription needs the numbers id and channelId";
    }
  } else if (operation == "unsubscribe") {
    for (const Json& unwanted : list_of(message, "subscriptionIds"))
      if (const auto id = number_of(unwanted)) unsubscribe(*id);
  } else {
    complaint_ = "only subscribe and unsubscribe are understood";
  }
}

void FoxgloveConversation::subscribe(std::uint32_t id, std::uint64_t channel) {
  const bool is_used = std::any_of(subscriptions_.begin(), subscriptions_.end(),
                                   [id](const auto& known) { return known.second == id; });
  if (channel == 0 || channel > kLiveTopics)
    complaint_ = "there is no channel " + std::to_string(channel);
  else if (is_used || subscriptions_.contains(static_cast<FoxgloveTopic>(channel - 1)))
    complaint_ = "subscription " + std::to_string(id) + ", or another of channel " + std::to_string(channel) +
                 ", is there already";
  else
    feed_.begin(subscriptions_.emplace(static_cast<FoxgloveTopic>(channel - 1), id).first->first);
}

void FoxgloveConversation::unsubscribe(std::uint32_t id) {
  const auto found = std::find_if(subscriptions_.begin(), subscriptions_.end(),
                                  [id](const auto& known) { return known.second == id; });
  if (found == subscriptions_.end()) return;
  feed_.end(found->first);
  subscriptions_.erase(found);
}

}  // namespace swiftlet
