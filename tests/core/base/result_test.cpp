// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/result.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace swiftlet {
namespace {

Result<int> half_of(int number) {
  if (number % 2 != 0) return Error{ErrorCode::kInvalidInput, "an odd number has no half"};
  return number / 2;
}

TEST(Result, HoldsTheValueOfASuccess) {
  const Result<int> result = half_of(8);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(*result, 4);
}

TEST(Result, HoldsTheReasonOfAFailure) {
  const Result<int> result = half_of(7);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(result.error().message, "an odd number has no half");
}

TEST(Result, GivesAwayAValueThatCanOnlyBeMoved) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(5));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
}

TEST(ResultDeathTest, StopsWhenAskedForWhatItDoesNotHold) {
  EXPECT_DEATH(static_cast<void>(half_of(7).value()), "broken promise");
  EXPECT_DEATH(static_cast<void>(half_of(8).error()), "broken promise");
}

TEST(Status, IsSuccessUnlessMadeOfAnError) {
  EXPECT_TRUE(Status().ok());
  const Status failed(Error{ErrorCode::kTimeout, "no packet"});
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, ErrorCode::kTimeout);
}

}  // namespace
}  // namespace swiftlet
