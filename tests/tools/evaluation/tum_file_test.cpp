// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/tum_file.hpp"

#include <gmock/gmock.h>

#include <chrono>

#include "daemon/outputs/tum_trajectory.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::microseconds;

TEST(TumFile, ReadsWhatARunWrites) {
  const HostTime stamp(microseconds(1'627'252'327'515'387));
  std::string text;
  append_tum_line(text, stamp, Pose2(1.5, -2.25, radians(-170.0)));
  append_tum_line(text, stamp + microseconds(1), Pose2());
  const TemporaryFile file("trajectory.tum", text);
  const Result<std::vector<StampedPose>> poses = read_tum_file(file.path());
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  ASSERT_EQ(poses->size(), 2U);
  EXPECT_EQ((*poses)[0].stamp, stamp);
  EXPECT_EQ((*poses)[0].pose.x_m(), 1.5);
  EXPECT_EQ((*poses)[0].pose.y_m(), -2.25);
  EXPECT_NEAR(degrees((*poses)[0].pose.yaw_rad()), -170.0, 1e-6);
  EXPECT_EQ((*poses)[1].stamp, stamp + microseconds(1));
}

TEST(TumFile, TakesTheHeadingOfAVehicleThatIsTilted) {
  // 30 degrees of yaw, then 20 of pitch, rounded to four digits.
  const TemporaryFile file("truth.tum", "1 0 0 0.5 -0.0449 0.1677 0.2549 0.9513\n");
  const Result<std::vector<StampedPose>> poses = read_tum_file(file.path());
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  EXPECT_NEAR(degrees(poses->front().pose.yaw_rad()), 30.0, 0.02);
}

TEST(TumFile, NamesTheLineWithoutRotation) {
  const TemporaryFile file("odd.tum", "# x\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 0.9\n");
  const Result<std::vector<StampedPose>> poses = read_tum_file(file.path());
  ASSERT_FALSE(poses.ok());
  EXPECT_EQ(poses.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(poses.error().message,
              testing::StartsWith(file.path() + ":3: columns 5 to 8 are no quaternion of length 1"));
}

TEST(TumFile, NamesTheLineWhoseStampIsNone) {
  const TemporaryFile file("nanoseconds.tum", "1627252327515387000 0 0 0 0 0 0 1\n");
  EXPECT_THAT(read_tum_file(file.path()).error().message, testing::StartsWith(file.path() + ":1: column 1"));
}

}  // namespace
}  // namespace swiftlet
