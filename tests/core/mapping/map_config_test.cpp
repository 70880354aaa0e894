// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_config.hpp"

#include <gmock/gmock.h>

#include <limits>

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

TEST(MapConfig, RefusesWhatIsNotANumber) {
  MapConfig config;
  config.resolution_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(config.validate().size(), 1U);
}

TEST(MapConfig, RefusesWhatIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const MapConfig config{.resolution_m = kInfinity,
                         .hit_log_odds = kInfinity,
                         .miss_log_odds = -kInfinity,
                         .clear_range_m = kInfinity};
  EXPECT_EQ(config.validate().size(), 4U);
}

}  // namespace
}  // namespace swiftlet
