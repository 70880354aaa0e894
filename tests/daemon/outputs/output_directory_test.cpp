// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/output_directory.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr HostTime kBegan{std::chrono::seconds(1'795'360'379)};  // 2026-11-22 15:12:59 UTC

TEST(FlightFolderName, HoldsTheMinuteAndTheNameOfTheInput) {
  EXPECT_EQ(flight_folder_name("sim://office?seed=7", kBegan), "2026-11-22_1512_office");
  EXPECT_EQ(flight_folder_name("/data/intel.clf.gz", kBegan), "2026-11-22_1512_intel");
  EXPECT_EQ(flight_folder_name("replay:my flight.pcap", kBegan), "2026-11-22_1512_my_flight");
  EXPECT_EQ(flight_folder_name("radio://0/80/2M/E7E7E7E7E7", kBegan),
            "2026-11-22_1512_radio_0_80_2M_E7E7E7E7E7");
  EXPECT_EQ(flight_folder_name("udp://127.0.0.1:19850", kBegan), "2026-11-22_1512_udp_127.0.0.1_19850");
  EXPECT_EQ(flight_folder_name(".pcap", kBegan), "2026-11-22_1512_flight");
}

TEST(OutputDirectory, RunsOfOneNameGetFoldersOfTheirOwn) {
  const TemporaryDirectory directory;
  const Result<OutputDirectory> first = OutputDirectory::make(directory.path() / "flights", "office");
  const Result<OutputDirectory> second = OutputDirectory::make(directory.path() / "flights", "office");
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->path(), directory.path() / "flights" / "office");
  EXPECT_EQ(second->path(), directory.path() / "flights" / "office_2");
}

TEST(OutputDirectory, IsOneRunsAlone) {
  const TemporaryDirectory directory;
  const fs::path out = directory.path() / "out";
  {
    const Result<OutputDirectory> first = OutputDirectory::open(out);
    ASSERT_TRUE(first.ok());
    EXPECT_TRUE(is_being_written_to(out));
    const Result<OutputDirectory> second = OutputDirectory::open(out);
    ASSERT_FALSE(second.ok());
    EXPECT_THAT(second.error().message, HasSubstr("out: another run writes there"));
    std::ofstream(out / "map.png") << "a map";
  }
  EXPECT_FALSE(is_being_written_to(out));
  EXPECT_TRUE(OutputDirectory::open(out).ok());
}

TEST(OutputDirectory, LeavesNoEmptyFolderOfItsOwn) {
  const TemporaryDirectory directory;
  const fs::path flights = directory.path() / "flights";
  fs::create_directory(directory.path() / "mine");
  EXPECT_TRUE(OutputDirectory::make(flights, "office").ok());
  EXPECT_TRUE(OutputDirectory::open(directory.path() / "out").ok());
  EXPECT_TRUE(OutputDirectory::open(directory.path() / "above" / "out" / "").ok());
  EXPECT_TRUE(OutputDirectory::open(directory.path() / "mine").ok());
  EXPECT_FALSE(fs::exists(flights));
  EXPECT_FALSE(fs::exists(directory.path() / "out"));
  EXPECT_FALSE(fs::exists(directory.path() / "above"));
  EXPECT_TRUE(fs::exists(directory.path() / "mine"));
  {
    const Result<OutputDirectory> used = OutputDirectory::make(flights, "office");
    std::ofstream(used->path() / "map.png") << "a map";
  }
  EXPECT_TRUE(fs::exists(flights / "office" / "map.png"));
}

TEST(OutputDirectory, RefusesWhatHasNoNameOrCannotBeWritten) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "in the way";
  EXPECT_THAT(OutputDirectory::open("").error().message, HasSubstr("-o names no directory"));
  EXPECT_THAT(OutputDirectory::open(directory.path() / "file").error().message, HasSubstr("file"));
  EXPECT_THAT(OutputDirectory::make(directory.path() / "file", "x").error().message, HasSubstr("file"));
}

}  // namespace
}  // namespace swiftlet
