// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_config.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

TEST(MapConfig, DefaultsAreUsable) { EXPECT_TRUE(MapConfig{}.validate().empty()); }

TEST(MapConfig, NamesAllThatIsWrongAtOnce) {
  const MapConfig config{
      .resolution_m = 0.0, .hit_log_odds = -1.0, .miss_log_odds = 1.0, .clear_range_m = 0.0};
  EXPECT_THAT(config.validate(),
              testing::ElementsAre(testing::HasSubstr("resolution_m"), testing::HasSubstr("hit_log_odds"),
                                   testing::HasSubstr("miss_log_odds"), testing::HasSubstr("clear_range_m")));
}

}  // namespace
}  // namespace swiftlet
