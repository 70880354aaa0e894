// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/progress_bar.hpp"

#include <gmock/gmock.h>

#include <memory>

namespace swiftlet {
namespace {

using std::chrono::seconds;

TEST(ProgressText, ShowsShareAndTimeLeft) {
  EXPECT_EQ(progress_text(0.5, seconds(65), 10), "[#####.....] 50 %, 1:05 left");
  EXPECT_EQ(progress_text(0.25, seconds(1), 4), "[#...] 25 %, 0:03 left");
  EXPECT_EQ(progress_text(1.0, seconds(9), 4), "[####] 100 %, 0:00 left");
}

TEST(ProgressText, GuessesNoTimeBeforeTheFirstPercent) {
  EXPECT_EQ(progress_text(0.0, seconds(5), 4), "[....] 0 %");
  EXPECT_EQ(progress_text(0.009, seconds(5), 4), "[....] 0 %");
}

TEST(ProgressText, StaysInItsBoundsForAnyShare) {
  EXPECT_EQ(progress_text(-1.0, seconds(5), 4), "[....] 0 %");
  EXPECT_EQ(progress_text(7.0, seconds(5), 4), "[####] 100 %, 0:00 left");
}

TEST(ProgressBar, IsSilentWhereThereIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    const ProgressBar::Clock::time_point start{};
    ProgressBar bar(file, start);
    bar.update(0.5, start + seconds(1));
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace
}  // namespace swiftlet
