// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/file_writer.hpp"

#include <gmock/gmock.h>

#include <cerrno>
#include <iterator>
#include <string>
#include <vector>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

TEST(WriteFile, WritesAllBytesAndLeavesNothingElse) {
  const TemporaryDirectory directory;
  const std::string bytes("a\0b\n", 4);
  ASSERT_TRUE(write_file(directory.path() / "file", bytes).ok());
  EXPECT_EQ(text_of(directory.path() / "file"), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 1);
}

TEST(WriteFile, ReplacesAnOlderFile) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file", "a long first text").ok());
  ASSERT_TRUE(write_file(directory.path() / "file", "second").ok());
  EXPECT_EQ(text_of(directory.path() / "file"), "second");
}

TEST(WriteFile, KeepsTheOldFileWhenItFails) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file", "old").ok());
  for (int i = 0; i < 100; ++i)  // stand in the way
    fs::create_directory(directory.path() / ("file.unfinished" + (i == 0 ? "" : std::to_string(i))));
  const Status status = write_file(directory.path() / "file", "new");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, testing::HasSubstr((directory.path() / "file").string()));
  EXPECT_EQ(text_of(directory.path() / "file"), "old");
}

TEST(WriteFile, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryDirectory directory;
  fs::create_symlink("/dev/full", directory.path() / "file");
  int pieces = 0;
  const Status status = write_file(directory.path() / "file", [&pieces](const FileSink& write) {
    while (write(std::string(100'000, 'x'))) ++pieces;
    errno = 0;
    return Status();
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(pieces, 0) << "the rest is not asked for";
  EXPECT_EQ(status.error().code, ErrorCode::kOutOfSpace);
  EXPECT_THAT(status.error().message, testing::HasSubstr("No space left"));
  EXPECT_TRUE(fs::is_symlink(directory.path() / "file")) << "it goes where the link leads";
}

TEST(WriteFile, LeavesWhatAnInterruptedProgramHasLeft) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file.unfinished", "a recording").ok());
  ASSERT_TRUE(write_file(directory.path() / "file", "new").ok());
  EXPECT_EQ(text_of(directory.path() / "file.unfinished"), "a recording");
  EXPECT_EQ(text_of(directory.path() / "file"), "new");
}

TEST(WriteFile, FollowsALink) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file", "old").ok());
  fs::create_symlink("file", directory.path() / "link");
  ASSERT_TRUE(write_file(directory.path() / "link", "new").ok());
  EXPECT_TRUE(fs::is_symlink(directory.path() / "link"));
  EXPECT_EQ(text_of(directory.path() / "file"), "new");
  fs::create_symlink("link to come", directory.path() / "first");
  fs::create_symlink(directory.path() / "to come", directory.path() / "link to come");
  ASSERT_TRUE(write_file(directory.path() / "first", "here").ok());
  EXPECT_EQ(text_of(directory.path() / "to come"), "here");
}

TEST(CheckOutputFile, AsksTheDirectoryThatALinkLeadsTo) {
  const TemporaryDirectory directory;
  fs::create_symlink("nowhere/file", directory.path() / "link");
  const Status status = check_output_file(directory.path() / "link", {});
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message,
              testing::HasSubstr("there is no directory " + (directory.path() / "nowhere").string()));
  EXPECT_TRUE(check_output_file("/dev/null", {}).ok());
}

TEST(RecordFile, KeepsWhatWasWrittenAndTellsWhere) {
  const TemporaryDirectory directory;
  const Status written = record_file(directory.path() / "file", [&](const FileSink& write) {
    write("what was received");
    fs::create_directories(directory.path() / "file" / "in the way");  // as if the disk failed
    return Status();
  });
  ASSERT_FALSE(written.ok());
  const fs::path kept = directory.path() / "file.unfinished";
  EXPECT_THAT(written.error().message, testing::HasSubstr(kept.string()));
  EXPECT_EQ(text_of(kept), "what was received");
}

TEST(CheckOutputFile, RefusesWhatCannotBeWritten) {
  const TemporaryDirectory directory;
  const fs::path input = directory.path() / "input";
  ASSERT_TRUE(write_file(input, "in").ok());
  fs::create_symlink("input", directory.path() / "link");
  const std::vector<fs::path> inputs{"there is none", input};
  EXPECT_TRUE(check_output_file(directory.path() / "output", inputs).ok());
  for (const fs::path& path : {fs::path(), directory.path(), input, directory.path() / "link",
                               directory.path() / "nowhere" / "output"}) {
    const Status status = check_output_file(path, inputs);
    ASSERT_FALSE(status.ok()) << path;
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(status.error().message, testing::HasSubstr(path.string()));
  }
}

TEST(PrepareOutputDirectory, CreatesWhatIsMissing) {
  const TemporaryDirectory directory;
  EXPECT_TRUE(prepare_output_directory(directory.path() / "a" / "b").ok());
  EXPECT_TRUE(prepare_output_directory(directory.path() / "a" / "b").ok());
  EXPECT_TRUE(fs::is_directory(directory.path() / "a" / "b"));
}

TEST(PrepareOutputDirectory, RefusesAFileInItsPlace) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file", "").ok());
  for (const fs::path& path : {directory.path() / "file", directory.path() / "file" / "below"}) {
    const Status status = prepare_output_directory(path);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(status.error().message, testing::HasSubstr(path.string()));
  }
}

TEST(WriteFile, WritesPieceByPiece) {
  const TemporaryDirectory directory;
  const Status written = write_file(directory.path() / "file", [](const FileSink& write) {
    write("one ");
    write("two");
    return Status();
  });
  ASSERT_TRUE(written.ok());
  EXPECT_EQ(text_of(directory.path() / "file"), "one two");
}

TEST(WriteFile, LeavesTheOldFileWhereTheContentFails) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory.path() / "file", "old").ok());
  const Status written = write_file(directory.path() / "file", [](const FileSink& write) {
    write("half of the n");
    return Status(Error{ErrorCode::kDamaged, "the rest is lost"});
  });
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().message, "the rest is lost");
  EXPECT_EQ(text_of(directory.path() / "file"), "old");
  EXPECT_FALSE(fs::exists(directory.path() / "file.unfinished"));
}

}  // namespace
}  // namespace swiftlet
