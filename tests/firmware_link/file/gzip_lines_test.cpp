// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/gzip_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <string>
#include <vector>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct WholeRead {
  std::vector<std::string> lines;
  Error end;
};
WholeRead read_all(const std::string& path) {
  WholeRead read;
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) {
    read.end = lines.error();
    return read;
  }
  for (;;) {
    const Result<std::string_view> line = lines->next();
    if (!line) {
      read.end = line.error();
      return read;
    }
    read.lines.emplace_back(*line);
    EXPECT_EQ(lines->line_number(), read.lines.size());
  }
}

void write_gzip(const std::string& path, const std::string& text) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
}

TEST(GzipLines, ReadsPlainTextWithAnyLineEnd) {
  const TemporaryFile file("a.clf", "one\n\r\ntwo\r\nlast without end");
  const WholeRead read = read_all(file.path());
  EXPECT_THAT(read.lines, ElementsAre("one", "", "two", "last without end"));
  EXPECT_EQ(read.end.code, ErrorCode::kEndOfRecording);
}

TEST(GzipLines, LeavesOutAByteOrderMark) {
  const TemporaryFile file("marked.csv",
                           "\xEF\xBB\xBF"
                           "one\n\xEF\xBB\xBFtwo\n");
  EXPECT_THAT(read_all(file.path()).lines, ElementsAre("one", "\xEF\xBB\xBFtwo"));
}

TEST(GzipLines, DetectsGzipByContentNotByName) {
  const TemporaryFile file("plain.txt");
  write_gzip(file.path(), "one\ntwo\n");
  EXPECT_THAT(read_all(file.path()).lines, ElementsAre("one", "two"));
}

TEST(GzipLines, LinesMayBeLongerThanItsBuffer) {
  const std::string longest(1'000'000, 'x');
  const TemporaryFile file("a.clf", "a\n" + longest + "\nb\n");
  EXPECT_THAT(read_all(file.path()).lines, ElementsAre("a", longest, "b"));
}

TEST(GzipLines, EndsAtALineWithoutEndBeforeItTakesAllMemory) {
  const TemporaryFile file("a.txt", "one\n" + std::string(std::size_t{18} << 20U, 'x'));
  const WholeRead read = read_all(file.path());
  EXPECT_THAT(read.lines, ElementsAre("one"));
  EXPECT_EQ(read.end.code, ErrorCode::kDamaged);
  EXPECT_THAT(read.end.message, HasSubstr("line 2 is longer than 16 MB"));
}

TEST(GzipLines, DeliversWholeLinesBeforeDamageAndReportsTheByte) {
  std::mt19937 random(3);
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += std::to_string(random()) + "\n";
  const TemporaryFile file("a.clf.gz");
  write_gzip(file.path(), text);
  const std::vector<std::string> whole = read_all(file.path()).lines;
  const std::string bytes = file.read();
  file.write(std::string_view(bytes).substr(0, bytes.size() / 2));
  const WholeRead read = read_all(file.path());
  EXPECT_EQ(read.end.code, ErrorCode::kDamaged);
  EXPECT_THAT(read.end.message, HasSubstr("byte " + std::to_string(bytes.size() / 2)));
  ASSERT_GT(read.lines.size(), 5000U);
  for (std::size_t i = 0; i < read.lines.size(); ++i) ASSERT_EQ(read.lines[i], whole[i]);
}

}  // namespace
}  // namespace swiftlet
