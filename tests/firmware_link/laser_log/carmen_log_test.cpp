// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/carmen_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/firmware_link/laser_lines.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::HasSubstr;

HostTime at_us(std::int64_t us) { return HostTime(microseconds(us)); }

TEST(CarmenLog, ReadsScansAndOdometry) {
  const TemporaryFile file("a.clf", "# a comment\nPARAM robot_length 1\n" +
                                        odometry_line(0.5, 0.25, 1.0, "10.100000") +
                                        flaser_line(180, 0.5, "10.150000"));
  const auto log = read_carmen_log(file.path(), 4);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_EQ(log->lines, 4U);
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->scans[0].stamp, at_us(10'150'000));
  EXPECT_DOUBLE_EQ(log->scans[0].position.x_m, 0.5);
  EXPECT_DOUBLE_EQ(log->scans[0].position.y_m, 0.2);
  EXPECT_DOUBLE_EQ(log->scans[0].yaw_rad, 0.3);
  EXPECT_THAT(log->distances_of(0), ElementsAre(1.00F, 1.60F, 2.20F, 2.79F));
  ASSERT_EQ(log->odometry.size(), 1U);
  EXPECT_EQ(log->odometry[0].stamp, at_us(10'100'000));
  EXPECT_DOUBLE_EQ(log->odometry[0].yaw_rad, 1.0);
  EXPECT_TRUE(log->problems.empty());
}

TEST(CarmenLog, BearingsFollowFromTheCount) {
  const auto bearings = [](int readings) {
    const TemporaryFile file("a.clf", flaser_line(readings, 0.0, "1"));
    return read_carmen_log(file.path(), 3)->beams;
  };
  EXPECT_NEAR(bearings(180).bearing_rad[0], radians(-90.0), 1e-12);
  EXPECT_NEAR(bearings(180).bearing_rad[1], radians(0.0), 1e-12);
  EXPECT_NEAR(bearings(180).bearing_rad[2], radians(89.0), 1e-12);
  EXPECT_NEAR(bearings(181).bearing_rad[2], radians(90.0), 1e-12);
  EXPECT_NEAR(bearings(360).bearing_rad[2], radians(89.5), 1e-12);
  EXPECT_NEAR(bearings(361).bearing_rad[1], radians(0.0), 1e-12);
  EXPECT_EQ(bearings(361).count, 3);
}

TEST(CarmenLog, SortsByTimeAndDropsScansThatRepeat) {
  const TemporaryFile file("a.clf", flaser_line(180, 3.0, "3.0") + flaser_line(180, 1.0, "1.0") +
                                        flaser_line(180, 1.0, "1.0") + flaser_line(180, 2.0, "1.0", 5.0) +
                                        odometry_line(0, 0, 0, "2") + odometry_line(0, 0, 0, "1"));
  const auto log = read_carmen_log(file.path(), 2);
  ASSERT_TRUE(log.ok());
  ASSERT_EQ(log->scans.size(), 3U);
  EXPECT_DOUBLE_EQ(log->scans[0].position.x_m, 1.0);
  EXPECT_DOUBLE_EQ(log->scans[1].position.x_m, 2.0);  // the same stamp, but another scan
  EXPECT_FLOAT_EQ(log->distances_of(1)[0], 5.0F);
  EXPECT_DOUBLE_EQ(log->scans[2].position.x_m, 3.0);
  EXPECT_EQ(log->duplicate_scans, 1U);
  EXPECT_EQ(log->scan_reversals, 1U);
  EXPECT_EQ(log->odometry_reversals, 1U);
  EXPECT_LT(log->odometry[0].stamp, log->odometry[1].stamp);
}

TEST(CarmenLog, ReportsMalformedLinesAndContinues) {
  const std::string good = flaser_line(180, 0.0, "5");
  const std::string cut = good.substr(0, good.size() / 2) + "\n";
  std::string text = good + cut + "ODOM 1 2 x 0 0 0 5\n" + flaser_line(90, 0.0, "6") + "FLASER\n" +
                     flaser_line(180, 0.0, "nan") + flaser_line(180, 0.0, "7");
  for (int i = 0; i < 20; ++i) text += "ODOM broken\n";
  const TemporaryFile file("a.clf", text);
  const auto log = read_carmen_log(file.path(), 11);
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log->scans.size(), 2U);
  ASSERT_EQ(log->problems.size(), 11U);
  EXPECT_THAT(log->problems[0],
              HasSubstr(file.path() + ":2: FLASER line cut off or garbled; the line is left out"));
  EXPECT_THAT(log->problems[1], HasSubstr(":3: ODOM line"));
  EXPECT_THAT(log->problems[2], HasSubstr(":4: FLASER with a number of readings that no"));
  EXPECT_THAT(log->problems[3], HasSubstr(":6: FLASER line"));
  EXPECT_THAT(log->problems.back(), HasSubstr("14 more malformed lines were left out"));
}

TEST(CarmenLog, ReportsWhyThereIsNothingToRead) {
  const TemporaryFile other("a.clf", "hello\n");
  EXPECT_THAT(read_carmen_log(other.path(), 4).error().message,
              HasSubstr("neither a capture (pcap) nor a table (.csv) nor a CARMEN"));
  const TemporaryFile odd("b.clf", flaser_line(90, 0.0, "1"));
  EXPECT_THAT(read_carmen_log(odd.path(), 4).error().message,
              HasSubstr(":1: FLASER with a number of readings"));
  EXPECT_EQ(read_carmen_log("/nonexistent/a.clf", 4).error().code, ErrorCode::kNotFound);
}

/// FLASER 181 n .. with poses of laser and robot.
std::string flaser_line_with_poses(const Pose2& laser, const Pose2& robot, const std::string& stamp) {
  char poses[160];
  std::snprintf(poses, sizeof poses, "%.3f %.3f %.4f %.3f %.3f %.4f", laser.x_m(), laser.y_m(),
                laser.yaw_rad(), robot.x_m(), robot.y_m(), robot.yaw_rad());
  std::string line = "FLASER 181";
  for (int i = 0; i < 181; ++i) line += " 2.5";
  return line + " " + poses + " " + stamp + " host " + stamp + "\n";
}

TEST(CarmenLog, FindsTheLaserOnTheRobotByTheTwoPosesOfEachLine) {
  const Pose2 T_robot_laser(0.3, 0.05, 0.0);
  std::string mounted = odometry_line(4.0, 0.0, 1.0, "1");
  std::string estimated;
  for (int i = 0; i < 20; ++i) {
    const Pose2 robot(0.1 * i, 0.05 * i, 0.3 * i);
    const Pose2 estimate = Pose2(0.02 * i, -0.01 * i, 0.002 * i) * robot * T_robot_laser;
    mounted += flaser_line_with_poses(robot * T_robot_laser, robot, std::to_string(i + 1));
    estimated += flaser_line_with_poses(estimate, robot, std::to_string(i + 1));
  }
  const TemporaryFile of_mounted("a.clf", mounted);
  const auto log = read_carmen_log(of_mounted.path(), 4);
  ASSERT_TRUE(log.ok()) << log.error().message;
  const Pose2 expected = Pose2(1.0, 0.5, 3.0) * T_robot_laser;
  EXPECT_NEAR(log->scans.at(10).position.x_m, expected.x_m(), 2e-3);
  EXPECT_NEAR(log->scans.at(10).position.y_m, expected.y_m(), 2e-3);
  EXPECT_NEAR(log->odometry.at(0).position.x_m, 4.0 + 0.3 * std::cos(1.0) - 0.05 * std::sin(1.0), 2e-3);
  const TemporaryFile of_estimated("b.clf", estimated);
  EXPECT_EQ(read_carmen_log(of_estimated.path(), 4)->scans.at(10).position.x_m, 1.0);
}

TEST(CarmenLog, FindsTheLaserByLinesOfTwoDecimalsBehindSomeWithoutAPose) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += flaser_line_with_poses(Pose2(), Pose2(), std::to_string(i + 1));
  const auto in_hundredths = [](const Pose2& T) {
    return Pose2(std::round(100.0 * T.x_m()) / 100.0, std::round(100.0 * T.y_m()) / 100.0,
                 std::round(100.0 * T.yaw_rad()) / 100.0);
  };
  for (int i = 0; i < 60; ++i) {
    const Pose2 robot(0.107 * i, 0.053 * i, 0.0313 * i);
    text += flaser_line_with_poses(in_hundredths(robot * Pose2(0.3, 0.1, 0.0)), in_hundredths(robot),
                                   std::to_string(i + 4));
  }
  const TemporaryFile file("a.clf", text);
  const auto log = read_carmen_log(file.path(), 4);
  ASSERT_TRUE(log.ok()) << log.error().message;
  const Pose2 expected = Pose2(1.07, 0.53, 0.313) * Pose2(0.3, 0.1, 0.0);
  EXPECT_NEAR(log->scans.at(13).position.x_m, expected.x_m(), 0.02);
  EXPECT_NEAR(log->scans.at(13).position.y_m, expected.y_m(), 0.02);
}

TEST(CarmenLog, TheHeadingIsTheRobotsHoweverItsLaserIsTurned) {
  // Laser, then robot: both at (1.5, 2) but for the turn, 0.5 rad and 0.1.
  const TemporaryFile file("a.clf", scan_line("ROBOTLASER1", "1 -2.0 4.0 0.5 30 0.1 0 9", 9,
                                              "0 1.5 2.0 0.5 1.5 2.0 0.1 0.1 0.2 9 9 9", "10.5") +
                                        odometry_line(4.0, 0.0, 0.2, "10.4"));
  const auto log = read_carmen_log(file.path(), 3);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_NEAR(log->scans.at(0).yaw_rad, 0.1, 1e-12);
  EXPECT_NEAR(log->odometry.at(0).yaw_rad, 0.2, 1e-12);
  EXPECT_NEAR(log->beams.bearing_rad[0], -2.0 + 0.4, 1e-12);
  EXPECT_NEAR(log->beams.bearing_rad[2], 2.0 + 0.4, 1e-12);
}

TEST(CarmenLog, KeepsItsBeamsWhereTheScannerIsStartedWithAnotherResolution) {
  const TemporaryFile file("a.clf", flaser_line(181, 0.0, "1") + flaser_line(361, 0.0, "2") +
                                        flaser_line(541, 0.0, "3") + flaser_line(401, 0.0, "4"));
  const auto log = read_carmen_log(file.path(), 3);
  ASSERT_TRUE(log.ok()) << log.error().message;
  ASSERT_EQ(log->scans.size(), 3U);
  EXPECT_THAT(log->distances_of(0), ElementsAre(1.00F, 1.90F, 2.80F));
  EXPECT_THAT(log->distances_of(1), ElementsAre(1.00F, 2.80F, 4.60F));
  EXPECT_THAT(log->distances_of(2), ElementsAre(1.90F, 3.70F, 5.50F));
  ASSERT_EQ(log->problems.size(), 1U) << "of three beams one lies within 100 degrees";
  EXPECT_THAT(log->problems[0], HasSubstr(":4: scan whose beams lie elsewhere"));
}

TEST(CarmenLog, ReadsScansThatSayHowTheirBeamsLie) {
  const TemporaryFile file("a.clf", scan_line("ROBOTLASER1", "1 -2.0 4.0 0.5 30 0.1 0 9", 9,
                                              "2 7 8 1.5 2.0 0.5 1.0 2.0 0.5 0.1 0.2 9 9 9", "10.5") +
                                        odometry_line(4.0, 0.0, 0.0, "10.4"));
  const auto log = read_carmen_log(file.path(), 3);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_TRUE(log->problems.empty());
  EXPECT_STREQ(log->scan_line, "ROBOTLASER1");
  EXPECT_EQ(log->max_range_m, 30.0);
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->scans[0].stamp, at_us(10'500'000));
  EXPECT_DOUBLE_EQ(log->scans[0].position.x_m, 1.5);
  EXPECT_DOUBLE_EQ(log->scans[0].yaw_rad, 0.5);
  EXPECT_NEAR(log->beams.bearing_rad[0], -2.0, 1e-12);
  EXPECT_NEAR(log->beams.bearing_rad[1], 0.0, 1e-12);
  EXPECT_NEAR(log->beams.bearing_rad[2], 2.0, 1e-12);
  EXPECT_THAT(log->distances_of(0), ElementsAre(1.0F, 1.04F, 1.08F));
  // The ODOM lines are the robot's: its laser is 0.5 m away, cos(0.5) of it ahead.
  EXPECT_NEAR(log->odometry.at(0).position.x_m, 4.0 + 0.5 * std::cos(0.5), 1e-9);
  EXPECT_NEAR(log->odometry.at(0).position.y_m, -0.5 * std::sin(0.5), 1e-9);
}

TEST(CarmenLog, TheBeamsOfAFullCircleLieEvenly) {
  const std::string readings = "0 -3.1 6.28 0.698131700797732 30 0.1 0 9";  // 40 degrees
  const TemporaryFile file("a.clf", scan_line("RAWLASER1", readings, 9, "0", "10.5"));
  const auto log = read_carmen_log(file.path(), 3);
  ASSERT_TRUE(log.ok()) << log.error().message;
  ASSERT_EQ(log->beams.count, 3);
  EXPECT_NEAR(log->beams.bearing_rad[1] - log->beams.bearing_rad[0], 2.0 * kPi / 3.0, 1e-9);
  EXPECT_NEAR(log->beams.bearing_rad[2] - log->beams.bearing_rad[1], 2.0 * kPi / 3.0, 1e-9);
}

TEST(CarmenLog, RawScansHaveNoPoses) {
  const TemporaryFile file("a.clf", scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", "10.5"));
  const auto log = read_carmen_log(file.path(), 2);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_FALSE(log->scans_have_poses);
  EXPECT_EQ(log->scans.size(), 1U);
}

TEST(CarmenLog, OfScansThatAreThereInSeveralKindsTheMostTellingCounts) {
  const std::string raw = scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", "10.5");
  const std::string robot =
      scan_line("ROBOTLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0 1 2 3 1 2 3 0 0 0 0 0", "10.5");
  const TemporaryFile both("a.clf", raw + robot + raw + robot);
  const auto log = read_carmen_log(both.path(), 2);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_STREQ(log->scan_line, "ROBOTLASER1");
  EXPECT_TRUE(log->scans_have_poses);
  EXPECT_EQ(log->duplicate_scans, 1U);
  EXPECT_EQ(log->scans.size(), 1U);
  const TemporaryFile all("b.clf", robot + flaser_line(180, 0.0, "11") + raw + robot);
  EXPECT_STREQ(read_carmen_log(all.path(), 2)->scan_line, "FLASER");
  EXPECT_EQ(read_carmen_log(all.path(), 2)->scans.size(), 1U);
}

TEST(CarmenLog, ReportsScansThatCannotBeUsed) {
  const std::string good = scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", "1");
  const TemporaryFile file("a.clf", good + scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 6, "0", "2") +
                                        scan_line("RAWLASER1", "0 -1 2.0 0.5 80 0.1 0 5", 5, "0", "3") +
                                        scan_line("RAWLASER1", "0 -1.5 3.0 0 80 0.1 0 7", 7, "0", "4") +
                                        scan_line("ROBOTLASER1", "0 -1.5 3.0 0.5 80 0.1 0 1", 1, "0", "5"));
  const auto log = read_carmen_log(file.path(), 2);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_EQ(log->scans.size(), 1U);
  ASSERT_EQ(log->problems.size(), 4U);
  EXPECT_THAT(log->problems[0], HasSubstr("RAWLASER1 line cut off or garbled"));
  EXPECT_THAT(log->problems[1], HasSubstr("beams lie elsewhere"));
  EXPECT_THAT(log->problems[2], HasSubstr("RAWLASER1 line cut off or garbled"));
  EXPECT_THAT(log->problems[3], HasSubstr("fewer than are to be kept"));
}

TEST(CarmenLog, ScansWithoutReadingsOrSpreadAreLeftOut) {
  const std::string good = scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 7", 7, "0", "1");
  const TemporaryFile file("a.clf", good + scan_line("RAWLASER1", "0 -1.5 3.0 0.5 80 0.1 0 0", 0, "0", "2") +
                                        scan_line("RAWLASER1", "0 -1.5 3.0 1e-9 80 0.1 0 7", 7, "0", "3"));
  const auto log = read_carmen_log(file.path(), 2);
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_EQ(log->scans.size(), 1U);
  EXPECT_THAT(log->problems, testing::Each(HasSubstr("RAWLASER1 line cut off or garbled")));
  EXPECT_EQ(log->problems.size(), 2U);
}

}  // namespace
}  // namespace swiftlet
