// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/python/mapping_thread.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <utility>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;

MapCommand mapping_of(const char* input) {
  MapCommand command;
  command.input = input;
  command.calibrate = false;
  return command;
}

TEST(MappingThread, GivesArraysOfOneLengthAndTheReport) {
  MappingThread mapping(mapping_of("sim://patrol"));
  while (!mapping.wait(milliseconds(1000))) {
  }
  const Result<MappedInput> mapped = mapping.take_result();
  ASSERT_TRUE(mapped) << mapped.error().message;
  const RunArrays& arrays = mapped->arrays;
  const std::size_t rows = arrays.trajectory.size() / kPoseColumns;
  EXPECT_GT(rows, 400U);
  EXPECT_EQ(arrays.odometry.size(), rows * kPoseColumns);
  EXPECT_EQ(arrays.covariances.size(), rows * kCovarianceSide * kCovarianceSide);
  const OccupancyGrid& grid = arrays.grids.at(StoreyId{0});
  EXPECT_EQ(grid.occupancy_percent.size(), grid.rows * grid.columns);
  EXPECT_THAT(mapped->report_json, HasSubstr("\"keyframes\""));
  EXPECT_THAT(mapped->problems, IsEmpty());
}

TEST(MappingThread, StopsBeforeTheEndAndWritesNothing) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "swiftlet_mapping_thread_test";
  MapCommand command = mapping_of("sim://office?laps=30");
  command.output_directory = folder.string();
  MappingThread mapping(command);
  while (!mapping.progress()) ASSERT_FALSE(mapping.wait(milliseconds(10)));
  mapping.stop();
  const Result<MappedInput> mapped = mapping.take_result();
  ASSERT_FALSE(mapped);
  EXPECT_EQ(mapped.error().code, ErrorCode::kTimeout);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(MappingThread, SaysWhatCannotBeUsed) {
  MappingThread mapping(mapping_of("nowhere.pcap"));
  while (!mapping.wait(milliseconds(1000))) {
  }
  const Result<MappedInput> mapped = mapping.take_result();
  ASSERT_FALSE(mapped);
  EXPECT_THAT(mapped.error().message, HasSubstr("nowhere.pcap"));
}

}  // namespace
}  // namespace swiftlet
