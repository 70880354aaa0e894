// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/link_condition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(LinkCondition, IsDescribedInOneLineWithARemedy) {
  EXPECT_THAT(std::string(describe(LinkCondition::kSilent)), HasSubstr("channel"));
  EXPECT_THAT(std::string(describe(LinkCondition::kDeviceMissing)), HasSubstr("plug it in"));
  EXPECT_THAT(std::string(describe(LinkCondition::kAccessDenied)), HasSubstr("plugdev"));
  EXPECT_THAT(std::string(describe(LinkCondition::kDeviceBusy)), HasSubstr("close it"));
  std::set<std::string_view> lines;
  for (int i = 0; i <= static_cast<int>(LinkCondition::kDeviceFault); ++i) {
    const std::string_view line = describe(static_cast<LinkCondition>(i));
    EXPECT_EQ(line.find('\n'), std::string_view::npos);
    EXPECT_TRUE(lines.insert(line).second) << line;
  }
}

TEST(LinkCondition, FollowsFromTheFailureOfTheDevice) {
  EXPECT_EQ(condition_of(UsbOutcome::kNoDevice), LinkCondition::kDeviceMissing);
  EXPECT_EQ(condition_of(UsbOutcome::kAccessDenied), LinkCondition::kAccessDenied);
  EXPECT_EQ(condition_of(UsbOutcome::kBusy), LinkCondition::kDeviceBusy);
  EXPECT_EQ(condition_of(UsbOutcome::kTimeout), LinkCondition::kDeviceMute);
  EXPECT_EQ(condition_of(UsbOutcome::kStall), LinkCondition::kDeviceStalls);
  EXPECT_EQ(condition_of(UsbOutcome::kOverflow), LinkCondition::kDeviceOverflows);
  EXPECT_EQ(condition_of(UsbOutcome::kFault), LinkCondition::kDeviceFault);
  EXPECT_EQ(condition_of(UsbOutcome::kUnsuited), LinkCondition::kDeviceUnsuited);
}

}  // namespace
}  // namespace swiftlet
