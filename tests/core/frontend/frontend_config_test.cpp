// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(FrontendConfig, IsUsableAsItComes) { EXPECT_THAT(FrontendConfig().validate(), IsEmpty()); }

TEST(FrontendConfig, NamesTheFieldAndTheRuleItBreaks) {
  FrontendConfig config;
  config.window_keyframes = 1000;
  EXPECT_THAT(config.validate(), ElementsAre("frontend.window_keyframes = 1000: must lie between 2 and 64"));
}

TEST(FrontendConfig, TellsAllProblemsAtOnce) {
  FrontendConfig config;
  config.keyframe_distance_m = 0.0;
  config.multiscan_points = 0;
  config.chi_square_confidence = 1.0;
  EXPECT_THAT(config.validate(), SizeIs(3));
}

TEST(FrontendConfig, RemembersWallsNoLongerThanTheWindow) {
  FrontendConfig config;
  config.association_keyframes = config.window_keyframes + 1;
  EXPECT_THAT(config.validate(),
              ElementsAre("frontend.association_keyframes must be at most window_keyframes"));
}

}  // namespace
}  // namespace swiftlet
