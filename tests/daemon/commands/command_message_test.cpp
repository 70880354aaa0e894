// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/daemon/commands/encoded_command.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(CommandMessage, SaysWhatIsAskedFor) {
  EXPECT_EQ(read_command(encoded_command(command_t::ACTION_SAVE_MAP))->kind, Command::Kind::kSaveMap);
  EXPECT_EQ(read_command(encoded_command(command_t::ACTION_NEW_MAP))->kind, Command::Kind::kNewMap);
  const auto mark = read_command(encoded_command(command_t::ACTION_MARK_PLACE,
                                                 "K\xC3\xBC"
                                                 "che 2"));
  ASSERT_TRUE(mark) << mark.error().message;
  EXPECT_EQ(mark->kind, Command::Kind::kMarkPlace);
  EXPECT_EQ(mark->name_text(),
            "K\xC3\xBC"
            "che 2");
}

TEST(CommandMessage, ANameFitsATable) {
  for (const std::string& name :
       {std::string(), std::string(61, 'a'), std::string("a,b"), std::string("a\"b"), std::string("a\nb")})
    EXPECT_THAT(read_command(encoded_command(command_t::ACTION_MARK_PLACE, name)).error().message,
                HasSubstr("1 to 60 bytes"))
        << name;
  EXPECT_TRUE(read_command(encoded_command(command_t::ACTION_MARK_PLACE, std::string(60, 'a'))));
}

TEST(CommandMessage, WhatIsNoCommandIsRefused) {
  EXPECT_THAT(read_command(encoded_command(9)).error().message, HasSubstr("there is no action 9"));
  EXPECT_THAT(read_command({}).error().message, HasSubstr("no command_t"));
  auto cut = encoded_command(command_t::ACTION_MARK_PLACE, "kitchen");
  cut.pop_back();
  EXPECT_FALSE(read_command(cut));
  auto claims_more = encoded_command(command_t::ACTION_MARK_PLACE, "kitchen");
  claims_more[9] = 0x7F;  // the highest byte of the length of the name
  EXPECT_FALSE(read_command(claims_more));
  claims_more[9] = 0x80;  // less than nothing
  EXPECT_FALSE(read_command(claims_more));
}

}  // namespace
}  // namespace swiftlet
