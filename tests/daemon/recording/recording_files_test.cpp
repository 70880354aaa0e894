// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_files.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "firmware_link/capture/capture_writer.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// Sets or, with nullptr, unsets a variable of the environment until it goes.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~EnvironmentVariable() { set(before_ ? before_->c_str() : nullptr); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  void set(const char* value) const {
    if (value != nullptr) {
      ::setenv(name_, value, 1);
    } else {
      ::unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(DefaultRecordingsDirectory, IsTheServicesOwnElseTheUsersStateDirectory) {
  const EnvironmentVariable home("HOME", "/home/pilot");
  const EnvironmentVariable xdg("XDG_STATE_HOME", "/var/pilot");
  const EnvironmentVariable service("STATE_DIRECTORY", "/var/lib/swiftlet:/var/lib/other");
  EXPECT_EQ(*default_recordings_directory(), "/var/lib/swiftlet");
  const EnvironmentVariable no_service("STATE_DIRECTORY", nullptr);
  EXPECT_EQ(*default_recordings_directory(), "/var/pilot/swiftlet/recordings");
  const EnvironmentVariable no_xdg("XDG_STATE_HOME", "");
  EXPECT_EQ(*default_recordings_directory(), "/home/pilot/.local/state/swiftlet/recordings");
  const EnvironmentVariable no_home("HOME", nullptr);
  const Result<fs::path> nowhere = default_recordings_directory();
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(nowhere.error().message, testing::HasSubstr("record.directory"));
}

TEST(RecordingName, SaysWhenTheRecordingBeganInUtcAndWhichPartItIs) {
  const HostTime began{std::chrono::seconds(1'795'258'555)};
  EXPECT_EQ(recording_name(began, 1), "swiftlet_20261121_105555.pcap");
  EXPECT_EQ(recording_name(began, 2), "swiftlet_20261121_105555_2.pcap");
}

TEST(SizeText, KeepsTwoDigitsAtLeast) {
  EXPECT_EQ(size_text(24), "24 bytes");
  EXPECT_EQ(size_text(9'999), "9999 bytes");
  EXPECT_EQ(size_text(296'048), "296 kB");
  EXPECT_EQ(size_text(64'000'000), "64 MB");
}

class RemoveOldestRecordings : public testing::Test {
 protected:
  void make(const std::string& name) const {
    std::ofstream(directory_.path() / name) << std::string(100, 'x');
  }
  [[nodiscard]] std::vector<std::string> remove(std::uint64_t keep_bytes) const {
    std::vector<std::string> names;
    for (const fs::path& path : remove_oldest_recordings(directory_.path(), keep_bytes)) {
      EXPECT_FALSE(fs::exists(path));
      names.push_back(path.filename());
    }
    return names;
  }
  TemporaryDirectory directory_;
};

TEST_F(RemoveOldestRecordings, GoesByTheTimeInTheNameAndThenByThePart) {
  make("swiftlet_20261121_105555_10.pcap");
  make("swiftlet_20261121_105555_2.pcap");
  make("swiftlet_20261121_105555.pcap");
  make("swiftlet_20251231_235959.pcap");
  make("swiftlet_20270101_000000.pcap");
  EXPECT_THAT(remove(500), IsEmpty());
  EXPECT_THAT(remove(200), ElementsAre("swiftlet_20251231_235959.pcap", "swiftlet_20261121_105555.pcap",
                                       "swiftlet_20261121_105555_2.pcap"));
}

TEST_F(RemoveOldestRecordings, NeverTouchesAnythingElse) {
  const std::vector<std::string> others{"flight.pcap",
                                        "swiftlet_.pcap",
                                        "swiftlet_20261121_105555.pcap.toml",
                                        "swiftlet_20261121-105555.pcap",
                                        "swiftlet_20261121_105555_.pcap",
                                        "swiftlet_20261121_105555_best.pcap",
                                        "swiftlet_20261121_1055551.pcap",
                                        "my_swiftlet_20261121_105555.pcap"};
  for (const std::string& name : others) make(name);
  fs::create_directory(directory_.path() / "swiftlet_20261121_105556.pcap");
  fs::create_symlink("flight.pcap", directory_.path() / "swiftlet_20261121_105557.pcap");
  EXPECT_THAT(remove(0), IsEmpty());
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(directory_.path() / name)) << name;
  EXPECT_TRUE(fs::is_symlink(directory_.path() / "swiftlet_20261121_105557.pcap"));
}

TEST_F(RemoveOldestRecordings, LeavesARecordingThatIsBeingWritten) {
  make("swiftlet_20270101_000000.pcap");
  const Result<CaptureWriter> writer =
      CaptureWriter::create((directory_.path() / "swiftlet_20261121_105555.pcap").string(), {});
  ASSERT_TRUE(writer.ok());
  EXPECT_THAT(remove(0), ElementsAre("swiftlet_20270101_000000.pcap"));
}

TEST_F(RemoveOldestRecordings, FindsNothingInADirectoryThatIsNotThere) {
  EXPECT_THAT(remove_oldest_recordings(directory_.path() / "none", 0), IsEmpty());
}

}  // namespace
}  // namespace swiftlet
