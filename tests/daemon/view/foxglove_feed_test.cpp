// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_feed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;

TEST(FoxgloveFeed, TimesBeginWithTheFirstPose) {
  RunHistory history;
  FoxgloveFeed feed{FoxglovePace{}};
  for (std::size_t i = 0; i < kFoxgloveTopics; ++i) feed.begin(static_cast<FoxgloveTopic>(i));
  ASSERT_TRUE(history.enter_run(7, 0.0));
  history.add_event(0, EventLevel::kBad, "the vehicle does not answer");
  history.add_status({.utime_us = 0});
  history.add_tile(0, uniform_tile({0, 0}, 1, 100), 0.05);
  history.add_walls(0, {{.id = 1, .end = {1.0F, 0.0F}}});
  history.add_closure({.index = 0}, false, 0);
  EXPECT_FALSE(feed.next(history, std::nullopt));
  add_whole_pose(history, 5 * kSecondUs, 0);
  std::vector<FoxgloveMessage> messages;
  while (const auto message = feed.next(history, std::nullopt)) messages.push_back(*message);
  EXPECT_THAT(messages, SizeIs(kFoxgloveTopics - 1)) << "of each but the trajectory";
  EXPECT_THAT(messages, Each(AllOf(Field(&FoxgloveMessage::utime_us, 5 * kSecondUs),
                                   Field(&FoxgloveMessage::json, HasSubstr(R"("sec":5,)")))));
}

TEST(FoxgloveFeed, AFirstPoseWithoutItsDeadReckoningIsNoOriginOfFrameOdom) {
  RunHistory history;
  ASSERT_TRUE(history.enter_run(7, 0.0));
  history.add_pose({.utime_us = kSecondUs, .sequence = 0, .map = {9.0, 9.0, 0.0}});
  history.add_local(0, {9.0, 9.0, 0.0});
  add_whole_pose(history, 2 * kSecondUs, 1);
  FoxgloveFeed feed{FoxglovePace{}};
  feed.begin(FoxgloveTopic::kPoseOdom);
  const auto message = feed.next(history, std::nullopt);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->utime_us, 2 * kSecondUs);
  EXPECT_THAT(message->json, HasSubstr(R"("x":3.0)"));
  feed.begin(FoxgloveTopic::kTransforms);
  EXPECT_EQ(feed.next(history, std::nullopt)->utime_us, 2 * kSecondUs);
}

}  // namespace
}  // namespace swiftlet
