// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/python/message_listener.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes bytes_of(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// One of the messages that carry the walls of a run.
Bytes walls_part(int first, int count, int total, std::int64_t map_id = 1) {
  landmarks_t part{};
  part.map_id = map_id;
  part.first = first;
  part.count = count;
  part.total = total;
  for (int i = 0; i < count; ++i)
    part.landmarks.push_back({.id = first + i, .storey = 0, .start = {}, .end = {}});
  return bytes_of(part);
}

/// What a listener receives of these (channel, bytes), by way of a log.
std::vector<DaemonMessage> received(const std::vector<std::pair<std::string, Bytes>>& sent) {
  const TemporaryFile log("log.lcm");
  {
    const auto lcm = LcmTransport::open("file://" + log.path() + "?mode=w");
    for (const auto& [channel, bytes] : sent) EXPECT_TRUE((*lcm)->publish(channel, bytes));
  }
  const std::vector<std::string> channels{"POSE", "LANDMARKS", "VEHICLE_EVENT", "STATUS"};
  auto listener = MessageListener::open("file://" + log.path() + "?mode=r&speed=0", "SWIFTLET_", channels);
  std::vector<DaemonMessage> messages;
  while (!(*listener)->has_ended())
    if (auto message = (*listener)->receive(milliseconds(100))) messages.push_back(std::move(*message));
  return messages;
}

TEST(MessageListener, PutsTheWallsOfSeveralMessagesTogether) {
  const auto messages = received({{"SWIFTLET_LANDMARKS", walls_part(0, 2, 5)},
                                  {"SWIFTLET_LANDMARKS", walls_part(2, 2, 5)},
                                  {"SWIFTLET_LANDMARKS", walls_part(4, 1, 5)}});
  ASSERT_THAT(messages, SizeIs(1));
  const std::vector<landmark_t>& walls = std::get<WallsMessage>(messages.front()).walls;
  ASSERT_THAT(walls, SizeIs(5));
  EXPECT_EQ(walls.back().id, 4);
}

TEST(MessageListener, HearsOfEvents) {
  const vehicle_event_t event{.utime = 3, .map_id = 1, .text = "land"};
  const auto messages = received({{"SWIFTLET_VEHICLE_EVENT", bytes_of(event)}});
  ASSERT_THAT(messages, SizeIs(1));
  EXPECT_EQ(std::get<vehicle_event_t>(messages.front()).text, "land");
}

TEST(MessageListener, WaitsForTheFirstOfTheWalls) {
  EXPECT_THAT(received({{"SWIFTLET_LANDMARKS", walls_part(2, 3, 5)},
                        {"SWIFTLET_LANDMARKS", walls_part(0, 2, 5)},
                        {"SWIFTLET_LANDMARKS", walls_part(2, 3, 5, 2)}}),
              IsEmpty())
      << "neither of a part without its beginning, nor of two runs";
}

TEST(MessageListener, LeavesOutWhatIsNoMessageOfItsChannel) {
  Bytes cut_off = bytes_of(status_t{});
  cut_off.pop_back();
  const auto messages = received({{"SWIFTLET_POSE", Bytes{1, 2, 3}},
                                  {"SWIFTLET_POSE", bytes_of(status_t{})},
                                  {"SWIFTLET_STATUS", cut_off},
                                  {"OTHER_POSE", bytes_of(pose_t{})},
                                  {"SWIFTLET_POSE", bytes_of(pose_t{})}});
  ASSERT_THAT(messages, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<pose_t>(messages.front()));
}

TEST(MessageListener, RefusesAChannelThatItDoesNotKnow) {
  const std::vector<std::string> channels{"POSES"};
  const auto listener = MessageListener::open("memq://", "SWIFTLET_", channels);
  ASSERT_FALSE(listener);
  EXPECT_THAT(listener.error().message, HasSubstr("\"POSES\""));
}

}  // namespace
}  // namespace swiftlet
