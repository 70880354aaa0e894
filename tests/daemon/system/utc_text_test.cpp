// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/utc_text.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

TEST(UtcText, IsOfTheSecondThatHasBegun) {
  constexpr const char* kForm = "%Y-%m-%d %H:%M:%S";
  EXPECT_EQ(utc_text(HostTime(milliseconds(1'795'258'555'999)), kForm), "2026-11-21 10:55:55");
  EXPECT_EQ(utc_text(HostTime(milliseconds(-1)), kForm), "1969-12-31 23:59:59");
}

}  // namespace
}  // namespace swiftlet
