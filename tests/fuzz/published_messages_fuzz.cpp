// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any bytes as LCM messages that `swiftlet view` receives, and what a page and Foxglove are told of them. Of
// each message byte 0: the channel, bit 7: ten seconds later. 1, 2: its size, little-endian. Then its bytes.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "core/base/check.hpp"
#include "daemon/view/foxglove_conversation.hpp"
#include "daemon/view/message_reader.hpp"
#include "tests/fuzz/shown_run.hpp"

namespace swiftlet {
namespace {

void read_all(std::span<const std::uint8_t> bytes, RunHistory& history) {
  constexpr std::size_t kHeadBytes = 3;
  MessageReader reader(history);
  MonotonicTime now{};
  while (bytes.size() >= kHeadBytes) {
    const std::size_t channel = (bytes[0] & 0x7FU) % viewed_channels().size();
    if ((bytes[0] & 0x80U) != 0) now += std::chrono::seconds(10);
    const std::size_t wanted = bytes[1] | static_cast<std::size_t>(bytes[2]) << 8U;
    bytes = bytes.subspan(kHeadBytes);
    const std::size_t size = std::min(wanted, bytes.size());
    reader.take(viewed_channels()[channel], bytes.first(size), now);
    bytes = bytes.subspan(size);
  }
}

void subscribe_to_all(FoxgloveConversation& conversation) {
  nlohmann::json wanted{{"op", "subscribe"}, {"subscriptions", nlohmann::json::array()}};
  for (std::size_t i = 1; i <= foxglove_channels().size(); ++i)
    wanted["subscriptions"].push_back({{"id", i}, {"channelId", i}});
  conversation.take(wanted.dump());
}

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  SharedRunHistory shared;
  read_all({data, size}, shared.history);
  const ShownSource source{.title = "fuzz", .is_recording = false, .rate = 1.0};
  Viewer viewer(shared, source);
  drain(viewer, [](const WebMessage& message) {
    SWIFTLET_CHECK(!message.is_text || nlohmann::json::accept(message.bytes), "a text is JSON");
  });
  FoxgloveConversation conversation(shared, source, [] { return MonotonicTime(); });
  subscribe_to_all(conversation);
  drain(conversation,
        [](const WebMessage& message) { SWIFTLET_CHECK(!message.bytes.empty(), "messages are not empty"); });
  return 0;
}
