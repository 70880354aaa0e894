// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/members.hpp"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::pair<std::string, double>> members_of(std::string_view text) {
  std::vector<std::pair<std::string, double>> members;
  for_each_member(text, [&](std::string_view name, double value) { members.emplace_back(name, value); });
  return members;
}

TEST(Members, AreNamesWithAndWithoutValues) {
  EXPECT_THAT(members_of("a b=2.5 c=-3"), ElementsAre(Pair("a", 0.0), Pair("b", 2.5), Pair("c", -3.0)));
  EXPECT_THAT(members_of("alone"), ElementsAre(Pair("alone", 0.0)));
  EXPECT_THAT(members_of("last=1"), ElementsAre(Pair("last", 1.0)));
  EXPECT_THAT(members_of(""), IsEmpty());
}

}  // namespace
}  // namespace swiftlet
