// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/numbered_path.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace swiftlet {
namespace {

TEST(NumberedPath, StandsBesideTheFirst) {
  EXPECT_EQ(numbered_path("out", 2), "out_2");
  EXPECT_EQ(numbered_path("maps/out/", 3), "maps/out_3");
  EXPECT_EQ(numbered_path("/tmp/flight.pcap", 2), "/tmp/flight_2.pcap");
}

TEST(NumberedPath, OfTheFolderOneStandsInHasItsName) {
  const std::filesystem::path here = std::filesystem::current_path();
  EXPECT_EQ(numbered_path(".", 2), here.string() + "_2");
}

TEST(NumberedLcmUrl, LeavesTheLogOfAnEarlierRunAlone) {
  const std::string log = testing::TempDir() + "numbered_path_test.lcm";
  std::ofstream(log) << "messages";
  const std::string later = testing::TempDir() + "numbered_path_test_2.lcm";
  EXPECT_EQ(numbered_lcm_url("file://" + log + "?speed=0&mode=w", 2), "file://" + later + "?speed=0&mode=w");
  EXPECT_EQ(numbered_lcm_url("file://" + log + "?mode=a", 2), "file://" + log + "?mode=a");
  std::filesystem::remove(log);
}

TEST(NumberedLcmUrl, IsNotConfusedByALogNamedLikeTheScheme) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(testing::TempDir());
  std::ofstream("file") << "messages";
  EXPECT_EQ(numbered_lcm_url("file://file?mode=w", 2), "file://file_2?mode=w");
  std::filesystem::remove("file");
  std::filesystem::current_path(before);
}

TEST(NumberedLcmUrl, OfWhatIsNoLogStays) {
  for (const char* url :
       {"udpm://239.255.76.67:7667?ttl=0", "memq://", "file:///dev/null?mode=w", "nonsense"})
    EXPECT_EQ(numbered_lcm_url(url, 2), url);
}

}  // namespace
}  // namespace swiftlet
