// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/motion_fault.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace swiftlet {
namespace {

TEST(MotionFault, ReadsSeveralInTheOrderOfTime) {
  const auto faults = parse_motion_faults("silence@12.5:3,reset@60,jump@60:-20,turn@70:-30");
  ASSERT_TRUE(faults.ok());
  ASSERT_EQ(faults->size(), 4U);
  EXPECT_EQ((*faults)[0].kind, MotionFaultKind::kSilence);
  EXPECT_EQ((*faults)[0].after, std::chrono::milliseconds(12500));
  EXPECT_EQ((*faults)[0].amount, 3.0);
  EXPECT_EQ((*faults)[1].kind, MotionFaultKind::kReset);
  EXPECT_EQ((*faults)[2].amount, -20.0);
  EXPECT_EQ((*faults)[3].kind, MotionFaultKind::kYawTurn);
  EXPECT_EQ((*faults)[3].amount, -30.0);
}

TEST(MotionFault, RefusesEachMistakeByName) {
  struct Mistake {
    const char* text;
    const char* said;
  };
  constexpr std::array kMistakes{Mistake{"", "names no fault"},
                                 Mistake{"crash@60", "must be silence, reset"},
                                 Mistake{"reset", "needs the seconds after which it begins"},
                                 Mistake{"reset@nan", "needs the seconds after which it begins"},
                                 Mistake{"reset@60:1", "takes no amount"},
                                 Mistake{"silence@60", "for how long or how far"},
                                 Mistake{"silence@60:-1", "for how long or how far"},
                                 Mistake{"jump@60:181", "for how long or how far"},
                                 Mistake{"reset@60,reset@59", "order of time"}};
  for (const Mistake& mistake : kMistakes) {
    const auto faults = parse_motion_faults(mistake.text);
    ASSERT_FALSE(faults.ok()) << mistake.text;
    EXPECT_THAT(faults.error().message, testing::HasSubstr(mistake.said)) << mistake.text;
  }
}

}  // namespace
}  // namespace swiftlet
