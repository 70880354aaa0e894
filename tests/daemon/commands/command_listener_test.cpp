// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_listener.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <vector>

#include "daemon/publish/lcm_transport.hpp"
#include "tests/daemon/commands/encoded_command.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{30};

TEST(CommandListener, HearsWhatLcmPublishesOnItsChannel) {
  const auto listener = CommandListener::open("127.0.0.1:0", "T_COMMAND");
  ASSERT_TRUE(listener) << listener.error().message;
  std::promise<std::string> heard;
  (*listener)->start([&heard](const Command& command) {
    heard.set_value(std::string(command.name_text()));
    return true;
  });
  const auto lcm = LcmTransport::open((*listener)->url(), kPatience);
  ASSERT_TRUE(lcm) << lcm.error().message;
  EXPECT_TRUE((*lcm)->publish("U_COMMAND", encoded_command(command_t::ACTION_MARK_PLACE, "attic")));
  EXPECT_TRUE((*lcm)->publish("T_COMMAND", encoded_command(9)));
  EXPECT_TRUE((*lcm)->publish("T_COMMAND", encoded_command(command_t::ACTION_MARK_PLACE, "kitchen")));
  std::future<std::string> name = heard.get_future();
  ASSERT_EQ(name.wait_for(kPatience), std::future_status::ready);
  EXPECT_EQ(name.get(), "kitchen");
  (*listener)->stop();
}

TEST(CommandListener, ProgramsThatStayAndSayNothingMoreKeepNobodyOut) {
  const auto listener = CommandListener::open("127.0.0.1:0", "T_COMMAND");
  ASSERT_TRUE(listener) << listener.error().message;
  constexpr std::size_t kPrograms = CommandListener::kMaxConnections + 1;
  std::atomic<std::size_t> heard = 0;
  std::promise<void> all;
  (*listener)->start([&](const Command&) {
    if (++heard == kPrograms) all.set_value();
    return true;
  });
  std::vector<std::unique_ptr<LcmTransport>> programs;
  for (std::size_t i = 0; i < kPrograms; ++i) {
    auto lcm = LcmTransport::open((*listener)->url(), kPatience);
    ASSERT_TRUE(lcm) << lcm.error().message;
    programs.push_back(std::move(*lcm));
    EXPECT_TRUE(
        programs.back()->publish("T_COMMAND", encoded_command(command_t::ACTION_MARK_PLACE, "kitchen")));
  }
  EXPECT_EQ(all.get_future().wait_for(kPatience), std::future_status::ready) << heard;
  (*listener)->stop();
}

TEST(CommandListener, ListensWithinThisMachineOnly) {
  for (const char* address : {"0.0.0.0:8450", "192.0.2.1:8450", "[::1]:8450", "example:8450"})
    EXPECT_THAT(CommandListener::open(address, "T").error().message, HasSubstr("from this machine alone"))
        << address;
  EXPECT_THAT(CommandListener::open("127.0.0.1:x", "T").error().message, HasSubstr("no address"));
}

TEST(CommandListener, SaysWhenAnotherProgramHasThePort) {
  const auto first = CommandListener::open("127.0.0.1:0", "T");
  ASSERT_TRUE(first);
  const std::string address = (*first)->url().substr(std::string("tcpq://").size());
  EXPECT_THAT(CommandListener::open(address, "T").error().message, HasSubstr("name another port"));
}

}  // namespace
}  // namespace swiftlet
