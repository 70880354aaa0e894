// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/live_view.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <thread>

#include "daemon/publish/lcm_publisher.hpp"
#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

class LiveViewTest : public testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<LiveView>> opened =
        LiveView::open({.host = "127.0.0.1", .port = 0}, {.title = "test"}, "T_");
    ASSERT_TRUE(opened) << opened.error().message;
    view_ = std::move(opened).value();
    publisher_ = publisher_on("T_");
  }
  std::unique_ptr<Publisher> publisher_on(const std::string& channel_prefix) {
    return make_message_publisher(
        [this](const std::string& channel, std::span<const std::uint8_t> message) {
          view_->take(channel, message);
          return true;
        },
        channel_prefix, 5);
  }
  template <typename Condition>
  void wait_until(Condition holds) {
    const auto patience_ends = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < patience_ends) {
      {
        const std::lock_guard lock(view_->shared().mutex);
        if (holds(view_->shared().history)) return;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    FAIL() << "not in time";
  }

  std::unique_ptr<LiveView> view_;
  std::unique_ptr<Publisher> publisher_;
};

TEST_F(LiveViewTest, WhatIsPublishedIsInTheRunThatIsShown) {
  publisher_->publish_pose({.stamp = HostTime(std::chrono::seconds(9)),
                            .sequence = 3,
                            .T_map_body = Pose2(1.0, 2.0, 0.5),
                            .beams = BeamReadings::of(BeamLayout::multiranger(), SensorModel::crazyflie())});
  publisher_->publish_tile(HostTime{}, uniform_tile({1, 2}, 1, 40), 0.05);
  wait_until([](const RunHistory& history) { return history.tiles().size() == 1; });
  const std::lock_guard lock(view_->shared().mutex);
  const auto poses = view_->shared().history.poses_after(0);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].map[1], 2.0);
  EXPECT_EQ(poses[0].ranges_m.size(), 4U);
}

TEST_F(LiveViewTest, MessagesOfOtherChannelsAreNotTaken) {
  publisher_on("U_")->publish_tile(HostTime{}, uniform_tile({3, 4}, 1, 40), 0.05);
  view_->take("T_NONSENSE", {});
  view_->take("T", {});
  publisher_->publish_tile(HostTime{}, uniform_tile({1, 2}, 1, 40), 0.05);
  wait_until([](const RunHistory& history) { return history.tiles().contains({1, 2}); });
  const std::lock_guard lock(view_->shared().mutex);
  EXPECT_EQ(view_->shared().history.tiles().size(), 1U);
}

TEST_F(LiveViewTest, APublisherIsNotHeldUpByAViewThatIsStuck) {
  {
    const std::lock_guard stuck(view_->shared().mutex);
    for (std::uint32_t version = 1; version <= 5000; ++version)  // many times what the mailbox holds
      publisher_->publish_tile(HostTime{}, uniform_tile({1, 2}, version, 40), 0.05);
    EXPECT_GT(view_->dropped(), 1000U);
  }
  wait_until([this](const RunHistory& history) {
    publisher_->publish_tile(HostTime{}, uniform_tile({3, 4}, 1, 40), 0.05);
    return history.tiles().contains({3, 4});
  });
}

/// Names of the threads that run after the calling one.
std::set<std::string> yielding_threads() {
  std::set<std::string> names;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream comm(task.path() / "comm");
    std::string name;
    std::getline(comm, name);
    const auto thread = static_cast<id_t>(std::stoi(task.path().filename()));
    if (::getpriority(PRIO_PROCESS, thread) > ::getpriority(PRIO_PROCESS, 0)) names.insert(name);
  }
  return names;
}

TEST_F(LiveViewTest, ItsThreadsCarryTheirNamesAndYieldToOthers) {
  wait_until([](const RunHistory&) {
    return yielding_threads() == std::set<std::string>{"view", "view-reader"};
  });
}

TEST(LiveView, AnAddressInUseIsRefused) {
  const auto first = LiveView::open({.host = "127.0.0.1", .port = 0}, {.title = "test"}, "T_");
  ASSERT_TRUE(first);
  const std::string url = (*first)->server().url();
  const auto port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  const auto second = LiveView::open({.host = "127.0.0.1", .port = port}, {.title = "test"}, "T_");
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("in use"), std::string::npos) << second.error().message;
}

}  // namespace
}  // namespace swiftlet
