// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace swiftlet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(FrontendConfig, IsUsableAsItComes) { EXPECT_THAT(FrontendConfig().validate(), IsEmpty()); }

TEST(FrontendConfig, NamesTheFieldAndTheRuleItBreaks) {
  FrontendConfig config;
  config.window_keyframes = 1000;
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("window_keyframes must be between 2 and 64")));
}

TEST(FrontendConfig, TellsAllProblemsAtOnce) {
  FrontendConfig config;
  config.keyframe_distance_m = 0.0;
  config.multiscan_points = 0;
  config.chi_square_confidence = 1.0;
  EXPECT_THAT(config.validate(), SizeIs(3));
}

TEST(FrontendConfig, RefusesNumbersThatAreNone) {
  FrontendConfig config;
  config.split_distance_m = std::numeric_limits<double>::quiet_NaN();
  config.association_gap_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(config.validate(), SizeIs(2));
}

TEST(FrontendConfig, RefusesWhatIsNotFinite) {
  FrontendConfig config;
  config.keyframe_distance_m = std::numeric_limits<double>::infinity();
  config.association_gap_m = std::numeric_limits<double>::infinity();
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("keyframe_distance_m must be above 0 and finite"),
                                             HasSubstr("association_gap_m must be 0 or more and finite")));
}

TEST(FrontendConfig, RemembersWallsNoLongerThanTheWindow) {
  FrontendConfig config;
  config.association_keyframes = config.window_keyframes + 1;
  EXPECT_THAT(config.validate(), ElementsAre(HasSubstr("association_keyframes")));
}

}  // namespace
}  // namespace swiftlet
