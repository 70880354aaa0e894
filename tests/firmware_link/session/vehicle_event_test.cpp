// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_event.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using Kind = VehicleEvent::Kind;

TEST(VehicleEvent, DescribesTheEventAndARemedy) {
  EXPECT_THAT(describe({Kind::kConnected, 12}), HasSubstr("protocol 12"));
  EXPECT_THAT(describe({Kind::kNoMultiranger, 0}), HasSubstr("deck.bcMultiranger is 0"));
  EXPECT_THAT(describe({Kind::kBatteryLow, 3150}), HasSubstr("3150 mV"));
  EXPECT_THAT(describe({Kind::kHeadingLeapt, 2}), HasSubstr("leapt as no vehicle can turn, 2 times so far"));
  for (int kind = 0; kind <= static_cast<int>(Kind::kClientBlocksLost); ++kind)
    EXPECT_FALSE(describe({static_cast<Kind>(kind), 0}).empty());
}

TEST(VehicleEvent, AConnectionIsNoWarning) {
  EXPECT_FALSE(is_warning({Kind::kConnected, 12}));
  EXPECT_TRUE(is_warning({Kind::kYawTrap, 0}));
}

}  // namespace
}  // namespace swiftlet
