// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_conversation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "swiftlet/status_t.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class FoxgloveConversationTest : public testing::Test {
 protected:
  SharedRunHistory shared_;
  MonotonicTime now_{};

  /// Greetings have been sent.
  std::unique_ptr<FoxgloveConversation> greeted(const ShownSource& source) {
    auto conversation = std::make_unique<FoxgloveConversation>(shared_, source, [this] { return now_; });
    EXPECT_TRUE(conversation->next());
    EXPECT_TRUE(conversation->next());
    return conversation;
  }
  void add_pose(std::int32_t sequence) {
    if (shared_.history.generation() == 0) {
      EXPECT_TRUE(shared_.history.enter_run(7, 0.0));
    }
    add_whole_pose(shared_.history, kSecondUs * (1 + sequence), sequence);
  }
  static std::vector<std::string> all(FoxgloveConversation& conversation) {
    std::vector<std::string> messages;
    while (const auto message = conversation.next()) messages.push_back(message->bytes);
    return messages;
  }
  /// Number of the channel of that topic.
  static int channel(FoxgloveTopic topic) { return channel_id(topic); }
  static std::string subscription(int id, FoxgloveTopic topic) {
    return json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel(topic)}}}}}.dump();
  }
  ShownSource live_{.title = "lcm", .is_recording = false, .rate = 1.0};
  ShownSource recording_{.title = "a.pcap", .is_recording = true, .rate = 2.0};
};

TEST_F(FoxgloveConversationTest, ChoosesTheNewerSubprotocolOfThoseOffered) {
  EXPECT_EQ(foxglove_subprotocol({"foxglove.websocket.v1", "foxglove.sdk.v1"}), "foxglove.sdk.v1");
  EXPECT_EQ(foxglove_subprotocol({"other", "foxglove.websocket.v1"}), "foxglove.websocket.v1");
  EXPECT_EQ(foxglove_subprotocol({"foxglove.websocket.v2"}), "");
  EXPECT_EQ(foxglove_subprotocol({}), "");
}

TEST_F(FoxgloveConversationTest, GreetsWithItsNameAndTheChannels) {
  FoxgloveConversation conversation(shared_, live_, [this] { return now_; });
  const auto info = conversation.next();
  ASSERT_TRUE(info && info->is_text);
  EXPECT_EQ(info->bytes, R"({"op":"serverInfo","name":"swiftlet: lcm","capabilities":[]})");
  const auto advertisement = conversation.next();
  ASSERT_TRUE(advertisement && advertisement->is_text);
  const json channels = json::parse(advertisement->bytes);
  EXPECT_EQ(channels["op"], "advertise");
  std::vector<std::string> topics;
  for (const json& one : channels["channels"]) {
    topics.push_back(one["topic"]);
    EXPECT_EQ(one["id"], topics.size());
    EXPECT_EQ(one["encoding"], "json");
    EXPECT_EQ(one["schemaEncoding"], "jsonschema");
    EXPECT_EQ(json::parse(one["schema"].get<std::string>())["title"], one["schemaName"]);
  }
  EXPECT_THAT(topics, ElementsAre("/tf", "/pose", "/pose_odom", "/map", "/walls", "/closures", "/trail",
                                  "/beams", "/log", "/status"));
  EXPECT_FALSE(conversation.next()) << "there is no run, and nobody has subscribed";
}

TEST_F(FoxgloveConversationTest, SendsWhatIsSubscribedToAsBytes) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  add_pose(0);
  EXPECT_FALSE(conversation.next());
  conversation.take(subscription(258, FoxgloveTopic::kPose));
  const auto message = conversation.next();
  ASSERT_TRUE(message);
  EXPECT_FALSE(message->is_text);
  // Opcode 1, the subscription's id, 1 s in nanoseconds; then the message.
  EXPECT_EQ(message->bytes.substr(0, 13), std::string("\x01\x02\x01\0\0\0\xca\x9a\x3b\0\0\0\0", 13));
  const json pose = json::parse(message->bytes.substr(13));
  EXPECT_EQ(pose["timestamp"], (json{{"sec", 1}, {"nsec", 0}}));
  EXPECT_EQ(pose["frame_id"], "map");
  EXPECT_EQ(pose["pose"]["position"], (json{{"x", 1.0}, {"y", 2.0}, {"z", 0.0}}));
  EXPECT_FALSE(conversation.next()) << "each pose once";
}

TEST_F(FoxgloveConversationTest, BeamsLeadFromTheBodyToTheirHits) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  conversation.take(subscription(3, FoxgloveTopic::kBeams));
  ASSERT_TRUE(shared_.history.enter_run(7, 0.0));
  shared_.history.add_pose({.utime_us = kSecondUs, .sequence = 1, .map = {1.0, 2.0, 0.5}});
  shared_.history.add_ranges(1, {0.0F, 1.0F, 2.0F}, {1.5F, 0.0F, -1.0F});
  shared_.history.add_local(1, {});
  shared_.history.add_odom(1, {});
  const auto message = conversation.next();
  ASSERT_TRUE(message);
  const json entity = json::parse(message->bytes.substr(13))["entities"][0];
  EXPECT_EQ(entity["frame_id"], "body");
  EXPECT_EQ(entity["timestamp"], (json{{"sec", 1}, {"nsec", 0}}));
  const json points = entity["lines"][0]["points"];
  ASSERT_EQ(points.size(), 2U) << "one beam of three hit";
  EXPECT_EQ(points[0]["x"], 0.0);
  EXPECT_EQ(points[1]["x"], 1.5);
  EXPECT_EQ(points[1]["y"], 0.0);
}

TEST_F(FoxgloveConversationTest, EndsASubscription) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  conversation.take(subscription(3, FoxgloveTopic::kPose));
  conversation.take(R"({"op":"unsubscribe","subscriptionIds":[3, 4, "x"]})");
  add_pose(0);
  EXPECT_FALSE(conversation.next());
  conversation.take(subscription(3, FoxgloveTopic::kPoseOdom));
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr("\"odom\"")));
}

TEST_F(FoxgloveConversationTest, ASlowClientGetsTheNewestPose) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  conversation.take(subscription(3, FoxgloveTopic::kPose));
  for (int i = 0; i < 1000; ++i) add_pose(i);
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr("\"sec\":1000,")));
}

TEST_F(FoxgloveConversationTest, PlaysARecordingAtItsRateFromTheFirstSubscriptionOn) {
  const auto greeted_one = greeted(recording_);
  FoxgloveConversation& conversation = *greeted_one;
  for (int i = 0; i < 10; ++i) add_pose(i);
  now_ += std::chrono::seconds(100);
  EXPECT_FALSE(conversation.next());
  conversation.take(subscription(3, FoxgloveTopic::kPose));
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr("\"sec\":1,")));
  now_ += std::chrono::seconds(1);
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr("\"sec\":2,"), HasSubstr("\"sec\":3,")));
}

TEST_F(FoxgloveConversationTest, SendsTheMapAsOneGridAndANewOneOnceItHasChanged) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  conversation.take(subscription(3, FoxgloveTopic::kMap));
  add_pose(0);
  shared_.history.add_tile(kSecondUs, uniform_tile({-1, 2}, 1, 100), 0.05);
  const std::vector<std::string> first = all(conversation);
  ASSERT_EQ(first.size(), 1U);
  const json grid = json::parse(first[0].substr(13));
  EXPECT_EQ(grid["column_count"], 64);
  EXPECT_DOUBLE_EQ(grid["pose"]["position"]["x"], -3.2);
  EXPECT_DOUBLE_EQ(grid["pose"]["position"]["y"], 6.4);
  EXPECT_THAT(grid["data"].get<std::string>(), testing::StartsWith("ZGRk"));
  add_pose(1);
  EXPECT_TRUE(all(conversation).empty()) << "nothing has changed";
  shared_.history.add_tile(2 * kSecondUs, uniform_tile({-1, 2}, 2, 0), 0.05);
  EXPECT_EQ(all(conversation).size(), 1U);
}

TEST_F(FoxgloveConversationTest, WhatTheFinalPassChangesIsSentThoughNoPoseFollows) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  RunHistory& history = shared_.history;
  int id = 0;
  for (const auto topic :
       {FoxgloveTopic::kMap, FoxgloveTopic::kWalls, FoxgloveTopic::kClosures, FoxgloveTopic::kTrail})
    conversation.take(subscription(++id, topic));
  add_pose(0);
  history.add_tile(kSecondUs, uniform_tile({0, 0}, 1, 100), 0.05);
  history.add_walls(kSecondUs, {{.id = 1, .end = {1.0F, 0.0F}}});
  history.add_closure({.index = 0}, false, kSecondUs);
  EXPECT_EQ(all(conversation).size(), 4U);
  history.add_pose({.utime_us = kSecondUs + 1, .sequence = 1, .map = {5.0, 5.0, 0.0}});
  history.add_local(1, {});
  history.add_odom(1, {});
  history.add_tile(kSecondUs + 1, uniform_tile({0, 0}, 2, 0), 0.05);
  history.add_walls(kSecondUs + 1, {{.id = 1, .end = {2.0F, 0.0F}}});
  history.add_closure({.index = 0}, true, kSecondUs + 1);
  EXPECT_TRUE(all(conversation).empty()) << "once a second while the run goes on";
  history.add_status({.utime_us = kSecondUs + 1, .state = status_t::STATE_FINISHED});
  EXPECT_EQ(all(conversation).size(), 4U);
  EXPECT_TRUE(all(conversation).empty()) << "each once";
}

TEST_F(FoxgloveConversationTest, ARecordingsFinalMapIsSentOnceItHasBeenPlayed) {
  const auto greeted_one = greeted(recording_);
  FoxgloveConversation& conversation = *greeted_one;
  RunHistory& history = shared_.history;
  for (int i = 0; i < 4; ++i) add_pose(i);
  for (std::uint32_t version = 1; version <= 4; ++version)  // at 2.5 s to 4 s
    history.add_tile((4 + version) * kSecondUs / 2, uniform_tile({0, 0}, version, 50), 0.05);
  history.add_status({.utime_us = 4 * kSecondUs, .state = status_t::STATE_FINISHED});
  conversation.take(subscription(3, FoxgloveTopic::kMap));
  EXPECT_TRUE(all(conversation).empty());
  // At 1.5 s to 4.5 s: one a second, and the last.
  for (const std::size_t maps : {0U, 0U, 1U, 0U, 1U, 1U, 0U}) {
    now_ += std::chrono::milliseconds(250);
    EXPECT_EQ(all(conversation).size(), maps);
  }
}

TEST_F(FoxgloveConversationTest, WhatWasDrawnIsClearedWhenANewRunBegins) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  conversation.take(subscription(3, FoxgloveTopic::kTrail));
  add_pose(0);
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr("\"corrected 0\"")));
  ASSERT_TRUE(shared_.history.enter_run(8, 0.0));
  add_pose(1);
  EXPECT_THAT(all(conversation), ElementsAre(HasSubstr(R"("deletions":[{)"), HasSubstr("\"corrected 0\"")));
}

TEST_F(FoxgloveConversationTest, AnswersWhatItDoesNotUnderstandWithAStatus) {
  const auto greeted_one = greeted(live_);
  FoxgloveConversation& conversation = *greeted_one;
  for (const char* text :
       {"", "{", "[]", "5", R"({"op":7})", R"({"op":"advertise"})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":1,"channelId":2}]})"}) {
    conversation.take(text);
    const auto answer = conversation.next();
    ASSERT_TRUE(answer) << text;
    EXPECT_EQ(json::parse(answer->bytes)["op"], "status") << text;
  }
  conversation.take(R"({"op":"subscribe"})");
  conversation.take(R"({"op":"unsubscribe","subscriptionIds":5})");
  EXPECT_FALSE(conversation.next());
}

}  // namespace
}  // namespace swiftlet
