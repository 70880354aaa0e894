// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/pose_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <utility>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/file_size_limit.hpp"

namespace swiftlet {
namespace {

StampedPose pose_number(int i) {
  return {HostTime(std::chrono::milliseconds(100) * i), Pose2(0.1 * i, -0.2 * i, 0.01 * (i % 300))};
}

TEST(PoseFile, ReturnsEveryPoseToTheLastBit) {
  PoseFile file = std::move(PoseFile::open()).value();
  for (int i = 0; i < 10'000; ++i) file.push_back(pose_number(i));
  EXPECT_TRUE(file.is_complete());
  const std::vector<StampedPose> poses = file.read();
  ASSERT_EQ(poses.size(), 10'000U);
  for (int i = 0; i < 10'000; ++i) {
    const auto& [stamp, pose] = poses[static_cast<std::size_t>(i)];
    ASSERT_EQ(stamp, pose_number(i).stamp);
    ASSERT_EQ(pose.vector(), pose_number(i).pose.vector());
  }
}

TEST(PoseFile, AcceptsMorePosesAfterItWasRead) {
  PoseFile file = std::move(PoseFile::open()).value();
  EXPECT_TRUE(file.read().empty());
  file.push_back(pose_number(1));
  EXPECT_EQ(file.read().size(), 1U);
  file.push_back(pose_number(2));
  ASSERT_EQ(file.read().size(), 2U);
  EXPECT_EQ(file.read()[1].stamp, pose_number(2).stamp);
}

TEST(PoseFile, ReportsAFullDisk) {
  PoseFile file = std::move(PoseFile::open()).value();
  const FileSizeLimit full_disk(100'000);
  for (int i = 0; i < 10'000; ++i) file.push_back(pose_number(i));
  EXPECT_FALSE(file.is_complete());
}

TEST(PoseFile, AllocatesNothingWhileItGrows) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  PoseFile file = std::move(PoseFile::open()).value();
  const test::AllocationCounter allocations;
  for (int i = 0; i < 10'000; ++i) file.push_back(pose_number(i));
  EXPECT_EQ(allocations.count(), 0U);
}

}  // namespace
}  // namespace swiftlet
