// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/view_service.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/publish/lcm_transport.hpp"
#include "swiftlet/pose_t.hpp"

namespace swiftlet {
namespace {

TEST(ViewLcm, EndsWithTheLogThatItReads) {
  const std::string log = testing::TempDir() + "swiftlet_view_service_test.lcm";
  const pose_t pose{};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(pose.getEncodedSize()));
  pose.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  ASSERT_TRUE((*LcmTransport::open("file://" + log + "?mode=w"))->publish("T_POSE", bytes));
  SharedRunHistory shared;
  std::stop_source stop;
  auto viewed = std::async(std::launch::async, [&] {
    return view_lcm("file://" + log + "?speed=0", "T_", shared, stop.get_token(), {}).ok();
  });
  EXPECT_EQ(viewed.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  stop.request_stop();
  EXPECT_TRUE(viewed.get());
  EXPECT_EQ(shared.history.generation(), 1U);
  std::filesystem::remove(log);
}

}  // namespace
}  // namespace swiftlet
