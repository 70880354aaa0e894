// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct KiteConfig {
  bool flies = true;
  int tails = 2;
  double line_m = 30.0;
  std::optional<double> wind_m_s;
  std::string colour = "red";

  static constexpr SettingsSection kSection{"kite", "What goes up."};
  static constexpr Setting<KiteConfig> kSettings[] = {
      {"flies", &KiteConfig::flies, "", "off the ground"},
      {"tails", &KiteConfig::tails, "", "how many", 0, 4},
      {"line_m", &KiteConfig::line_m, "m", "its length", 0.00001, 2000000},
      {"wind_m_s", &KiteConfig::wind_m_s, "m/s", "as measured", -0.5, 40},
      {"colour", &KiteConfig::colour, "", "of the sail"},
  };
};

TEST(SettingProblems, AreNoneOfDefaultsAndWhatIsNotSet) {
  EXPECT_THAT(setting_problems(KiteConfig()), IsEmpty());
}

TEST(SettingProblems, NameSectionKeyValueAndRange) {
  KiteConfig config;
  config.tails = 5;
  config.line_m = 0.0;
  config.wind_m_s = -1.0;
  EXPECT_THAT(setting_problems(config), ElementsAre("kite.tails = 5: must lie between 0 and 4",
                                                    "kite.line_m = 0: must lie between 1e-05 and 2000000",
                                                    "kite.wind_m_s = -1: must lie between -0.5 and 40"));
}

TEST(SettingProblems, AreNoneAtBothEndsOfARange) {
  KiteConfig config;
  for (const double end : {-0.5, 40.0}) {
    config.wind_m_s = end;
    EXPECT_THAT(setting_problems(config), IsEmpty());
  }
}

TEST(SettingProblems, NotANumberAndInfinityAreInNoRange) {
  KiteConfig config;
  config.line_m = std::numeric_limits<double>::infinity();
  config.wind_m_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(setting_problems(config), ElementsAre("kite.line_m = inf: must lie between 1e-05 and 2000000",
                                                    "kite.wind_m_s = nan: must lie between -0.5 and 40"));
}

TEST(ShortestText, GivesTheSameNumberBack) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-4, -123456.789, 9.999999e15, 1e16, 2.3e-308, 1.7e308})
    EXPECT_EQ(std::stod(shortest_text(value)), value) << shortest_text(value);
}

TEST(ShortestText, WritesExponentsOnlyWhereDigitsWouldBeMany) {
  EXPECT_EQ(shortest_text(100000000.0), "100000000");
  EXPECT_EQ(shortest_text(0.0001), "0.0001");
  EXPECT_EQ(shortest_text(1e16), "1e+16");
}

}  // namespace
}  // namespace swiftlet
