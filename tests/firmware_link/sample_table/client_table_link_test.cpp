// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/client_table_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Rows each 200 ms, along y at 0.5 m/s, forward being +y: as cfclient writes them.
std::string table(const std::string& columns, const std::string& end_of_row, int rows = 20) {
  std::string text = "Timestamp," + columns + "\n";
  for (int i = 0; i < rows; ++i)
    text.append(std::to_string(15'000 + 200 * i))
        .append(",")
        .append(std::to_string(0.1 * i))
        .append(end_of_row);
  return text;
}
const std::string kColumns =
    "stateEstimate.y,range.right,stateEstimate.x,range.front,stateEstimate.yaw,range.left,range.back,"
    "range.zrange,stateEstimate.pitch,stateEstimate.roll,pm.vbat";
const std::string kEndOfRow = ",32766,2.0,1500,90.0,500,2500,512,0.0,0.0,3.9\n";

std::vector<RangeSample> delivered_by(SampleSource& source) {
  std::vector<RangeSample> samples;
  while (const Result<ReceivedSample> next = source.next()) samples.push_back(next->sample);
  return samples;
}

TEST(ClientTableLink, GivesTheSamplesOfALogBlockThatTheClientSaved) {
  const TemporaryFile file("Ranges-20261127T12-00-00.csv", table(kColumns, kEndOfRow));
  SampleSourceOptions options;
  options.range_age = Duration::zero();
  const auto source = open_sample_source(file.path(), options);
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = delivered_by(**source);
  ASSERT_EQ(samples.size(), 20U);
  const RangeSample& sample = samples[10];
  EXPECT_EQ(sample.measured_at.time_since_epoch(), std::chrono::milliseconds(17'000));
  EXPECT_NEAR(sample.T_odom_body.x_m(), 2.0, 1e-6);
  EXPECT_NEAR(sample.T_odom_body.y_m(), 1.0, 1e-6);
  EXPECT_NEAR(sample.T_odom_body.yaw_rad(), kPi / 2.0, 1e-6);
  EXPECT_FLOAT_EQ(sample.distance_m[0], 1.5F);
  EXPECT_FLOAT_EQ(sample.distance_m[1], 0.5F);
  EXPECT_FLOAT_EQ(sample.distance_m[2], 2.5F);
  EXPECT_EQ(sample.status[3], RangeStatus::kNoReturn);
  EXPECT_TRUE((*source)->report().problems.empty());
  EXPECT_TRUE((*source)->report().notes.empty());
  EXPECT_EQ((*source)->report().counters.gaps, 0U);
}

TEST(ClientTableLink, ReadsTheOtherNamesOfTheFirmware) {
  const TemporaryFile file(
      "a.csv", table("kalman.stateX,kalman.stateY,stabilizer.yaw,range.front", ",0.5,-90.0,1500\n"));
  const auto source = open_sample_source(file.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = delivered_by(**source);
  ASSERT_EQ(samples.size(), 19U);
  EXPECT_NEAR(samples[5].T_odom_body.y_m(), 0.5, 1e-6);
  EXPECT_NEAR(samples[5].T_odom_body.yaw_rad(), -kPi / 2.0, 1e-6);
  const TemporaryFile packed("b.csv", table("kalman.stateX,kalman.stateY,stateEstimateZ.quat,range.front",
                                            ",0.5,3221225983,1500\n"));
  const auto with_quaternion = open_sample_source(packed.path(), {});
  ASSERT_TRUE(with_quaternion.ok()) << with_quaternion.error().message;
  EXPECT_NEAR((*with_quaternion)->next()->sample.T_odom_body.yaw_rad(), kPi / 2.0, 0.01);
}

TEST(ClientTableLink, AQuantityIsWholeWhateverStandsBetweenItsColumns) {
  const TemporaryFile file("Wide.csv",
                           table("stateEstimate.y,stateEstimate.qx,stateEstimate.vx,stateEstimate.vy,"
                                 "stateEstimate.ax,stateEstimate.ay,stateEstimate.x,stateEstimate.qy,"
                                 "stateEstimate.qz,stateEstimate.qw,range.front",
                                 ",0.0,0.5,0.0,0.0,0.0,2.0,0.0,0.0,1.0,1500\n"));
  const auto source = open_sample_source(file.path(), {});
  ASSERT_TRUE(source.ok()) << source.error().message;
  const std::vector<RangeSample> samples = delivered_by(**source);
  ASSERT_GT(samples.size(), 10U);
  EXPECT_NEAR(samples[5].T_odom_body.x_m(), 2.0, 1e-6);
  EXPECT_NEAR(samples[5].T_odom_body.yaw_rad(), 0.0, 1e-6);
}

TEST(ClientTableLink, AnUnusableRowEndsTheTable) {
  for (const char* const row :
       {"19000,1.0,x\n", "19000\n", "-5,0.5\n", "19000,1,32766,2,1500,90,500,2500,512,0,0,3.9,7\n"}) {
    const TemporaryFile file("a.csv", table(kColumns, kEndOfRow) + "\n" + row + "19200" + kEndOfRow);
    const auto source = open_sample_source(file.path(), {});
    ASSERT_TRUE(source.ok()) << source.error().message;
    EXPECT_EQ(delivered_by(**source).size(), 19U) << row;
    EXPECT_THAT((*source)->report().problems, ElementsAre(HasSubstr("line 23: is no row of a log block")))
        << row;
  }
}

TEST(ClientTableLink, ATableWithoutRowsIsNamed) {
  const TemporaryFile file("Head.csv", table(kColumns, kEndOfRow, 0));
  const auto source = open_sample_source(file.path(), {});
  ASSERT_FALSE(source.ok());
  EXPECT_THAT(source.error().message, HasSubstr("holds no packet and no row"));
}

TEST(ClientTableLink, WhatABlockLacksIsNamed) {
  const TemporaryFile file("a.csv", table("stateEstimate.x,stateEstimate.y,stateEstimate.yaw", ",0.5,0\n"));
  const auto source = open_sample_source(file.path(), {});
  ASSERT_FALSE(source.ok());
  EXPECT_THAT(source.error().message, HasSubstr("no range.front"));
}

TEST(ClientTableLink, IsKnownByItsFirstLine) {
  std::string too_many = "Timestamp";
  for (int i = 0; i < 27; ++i) too_many += ",a.b";
  for (const std::string& head : {std::string("Timestamp"), std::string("Time,range.front"), too_many}) {
    const TemporaryFile file("a.csv", head + "\n15000,1\n");
    EXPECT_FALSE(is_client_table(file.path())) << head;
    EXPECT_FALSE(open_sample_source(file.path(), {}).ok());
  }
}

}  // namespace
}  // namespace swiftlet
