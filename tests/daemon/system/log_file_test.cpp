// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/log_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class LogFileTest : public testing::Test {
 protected:
  TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path() / "swiftletd.log";
};

TEST_F(LogFileTest, TakesTheLogAndAppends) {
  for (const char* line : {"first run", "second run"}) {
    const auto file = LogFile::open(path_);
    ASSERT_TRUE(file.ok()) << file.error().message;
    spdlog::warn("{}", line);
  }
  EXPECT_THAT(text_of(path_), AllOf(HasSubstr("first run"), HasSubstr("second run")));
}

TEST_F(LogFileTest, GoesOnInANewFileWhenTheOldOneWasMovedAway) {
  const auto file = LogFile::open(path_);
  ASSERT_TRUE(file.ok());
  spdlog::warn("before");
  std::filesystem::rename(path_, directory_.path() / "swiftletd.log.1");
  (*file)->reopen();
  spdlog::warn("after");
  EXPECT_THAT(text_of(directory_.path() / "swiftletd.log.1"),
              AllOf(HasSubstr("before"), Not(HasSubstr("after"))));
  EXPECT_THAT(text_of(path_), AllOf(HasSubstr("after"), Not(HasSubstr("before"))));
}

TEST_F(LogFileTest, GoesOnInTheOldFileWhenThereIsNoNewOne) {
  const auto file = LogFile::open(path_);
  ASSERT_TRUE(file.ok());
  const std::filesystem::path moved = directory_.path() / "moved";
  std::filesystem::rename(path_, moved);
  std::filesystem::create_directory(path_);
  (*file)->reopen();
  spdlog::warn("after");
  EXPECT_THAT(text_of(moved), AllOf(HasSubstr("the log goes on where it was"), HasSubstr("after")));
}

TEST_F(LogFileTest, SaysThatTheFileCannotBeOpened) {
  const auto file = LogFile::open("/proc/nowhere/swiftletd.log");
  ASSERT_FALSE(file.ok());
  EXPECT_THAT(file.error().message, HasSubstr("/proc/nowhere/swiftletd.log"));
}

}  // namespace
}  // namespace swiftlet
