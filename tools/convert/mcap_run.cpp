// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/convert/mcap_run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

std::vector<McapChannel> channels() {
  std::vector<McapChannel> list;
  for (const FoxgloveChannel& channel : foxglove_channels())
    list.push_back({.id = channel.id,
                    .topic = channel.topic,
                    .message_encoding = kFoxgloveEncoding,
                    .schema_name = channel.schema_name,
                    .schema_encoding = kFoxgloveSchemaEncoding,
                    .schema = channel.schema});
  return list;
}

std::uint64_t nanoseconds(std::int64_t utime_us) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(utime_us, 0)) * 1000;
}

}  // namespace

McapRun::McapRun(FileSink write) : writer_(std::move(write), channels()), feed_(FoxglovePace{}) {
  for (std::size_t i = 0; i < kFoxgloveTopics; ++i) feed_.begin(static_cast<FoxgloveTopic>(i));
}

void McapRun::add_news(const RunHistory& history) {
  while (const auto message = feed_.next(history, std::nullopt))
    writer_.add(channel_id(message->topic), nanoseconds(message->utime_us), message->json);
}

void McapRun::add_last(const RunHistory& history) {
  feed_.hurry();
  add_news(history);
}

/// In chunks of their own: they lie beside all of the others in time.
Status McapRun::add_trajectory(const Backend& backend, const PrunedScans* pruned) {
  writer_.end_chunk();
  return for_each_scan(backend, pruned, [this](const TrajectoryPoint& at) {
    const std::int64_t utime_us =
        std::chrono::round<std::chrono::microseconds>(at.stamp.time_since_epoch()).count();
    writer_.add(channel_id(FoxgloveTopic::kTrajectory), nanoseconds(utime_us),
                pose_in_frame_json(utime_us, "map", at.T_map_body));
  });
}

}  // namespace swiftlet
