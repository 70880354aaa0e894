// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/number_rows.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <chrono>
#include <filesystem>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

std::string refusal_of(const std::string& text) {
  const TemporaryFile file("rows.txt", text);
  const Result<std::vector<NumberRow>> rows = read_number_rows(file.path());
  if (rows) return "accepted";
  EXPECT_EQ(rows.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(rows.error().message, testing::StartsWith(file.path() + ":"));
  return rows.error().message.substr(file.path().size());
}

TEST(NumberRows, AreTheLinesOfEightNumbersWithTheirPlaceInTheFile) {
  const TemporaryFile file("rows.txt",
                           "# stamp and so on\n"
                           "1.5 -2 3e2 4 5 6 7 8\r\n"
                           "\n"
                           "  # more to come\n"
                           " \t1\t2 3 4 5 6 7  8 ");
  const Result<std::vector<NumberRow>> rows = read_number_rows(file.path());
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_EQ((*rows)[0].line, 2U);
  EXPECT_THAT((*rows)[0].value, ElementsAre(1.5, -2.0, 300.0, 4.0, 5.0, 6.0, 7.0, 8.0));
  EXPECT_EQ((*rows)[1].line, 5U);
  EXPECT_THAT((*rows)[1].value, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0));
}

TEST(NumberRows, NameLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(refusal_of("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7\n"), ":2: has 7 columns, not 8 separated by blanks");
  EXPECT_EQ(refusal_of("1 2 3 4 5 6 7 8 9\n"), ":1: has 9 columns, not 8 separated by blanks");
  EXPECT_EQ(refusal_of("17\n"), ":1: has 1 column, not 8 separated by blanks");
  EXPECT_EQ(refusal_of("#\n1 2 x 4 5 6 7 8\n"), ":2: column 3, 'x', is no finite number");
  EXPECT_EQ(refusal_of("1 2 3 4 5 6 7 8m\n"), ":1: column 8, '8m', is no finite number");
  EXPECT_EQ(refusal_of("nan 2 3 4 5 6 7 8\n"), ":1: column 1, 'nan', is no finite number");
  EXPECT_EQ(refusal_of("1 2 3 4 5 6 7 1e999\n"), ":1: column 8, '1e999', is no finite number");
  EXPECT_EQ(refusal_of("\x1b[31mred 2 3 4 5 6 7 8\n"), ":1: column 1, '?[31mred', is no finite number");
}

TEST(NumberRows, MayHavePlusSigns) {
  const TemporaryFile file("rows.txt", "+1.5 -2 +3e+02 4 5 6 7 +8\n");
  const Result<std::vector<NumberRow>> rows = read_number_rows(file.path());
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  EXPECT_THAT(rows->front().value, ElementsAre(1.5, -2.0, 300.0, 4.0, 5.0, 6.0, 7.0, 8.0));
  EXPECT_EQ(refusal_of("+-1 2 3 4 5 6 7 8\n"), ":1: column 1, '+-1', is no finite number");
  EXPECT_EQ(refusal_of("1 ++2 3 4 5 6 7 8\n"), ":1: column 2, '++2', is no finite number");
  EXPECT_EQ(refusal_of("1 2 + 4 5 6 7 8\n"), ":1: column 3, '+', is no finite number");
  EXPECT_EQ(refusal_of("1 2 3 +inf 5 6 7 8\n"), ":1: column 4, '+inf', is no finite number");
}

TEST(NumberRows, MayBeginWithAByteOrderMark) {
  for (const char* const text : {"\xEF\xBB\xBF"
                                 "1 2 3 4 5 6 7 8\n",
                                 "\xEF\xBB\xBF# stamp and so on\n1 2 3 4 5 6 7 8\n"}) {
    const TemporaryFile file("rows.txt", text);
    const Result<std::vector<NumberRow>> rows = read_number_rows(file.path());
    ASSERT_TRUE(rows.ok()) << rows.error().message;
    ASSERT_EQ(rows->size(), 1U);
    EXPECT_EQ(rows->front().value[0], 1.0);
  }
  EXPECT_EQ(refusal_of("1 2 3 4 5 6 7 8\n\xEF\xBB\xBF"
                       "1 2 3 4 5 6 7 8\n"),
            ":2: column 1, '???1', is no finite number");
}

void write_cut_gzip(const std::string& path, const std::string& text) {
  gzFile packed = gzopen(path.c_str(), "wb");
  ASSERT_NE(packed, nullptr);
  gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
  gzclose(packed);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 8);  // its end, checksum and length
}

TEST(NumberRows, OfADamagedFileAreNotUsed) {
  const TemporaryFile file("rows.gz");
  ASSERT_NO_FATAL_FAILURE(write_cut_gzip(file.path(), "1 2 3 4 5 6 7 8\n2 2 3 4 5 6 7 8\n"));
  const Result<std::vector<NumberRow>> rows = read_number_rows(file.path());
  ASSERT_FALSE(rows.ok());
  EXPECT_EQ(rows.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(rows.error().message,
            file.path() +
                ": the gzip stream is cut off or garbled behind line 2, and nothing of it is used; "
                "take a whole copy");
}

TEST(NumberRows, AreAtLeastOne) {
  EXPECT_THAT(refusal_of("# nothing\n"), HasSubstr("holds no line of numbers"));
  EXPECT_THAT(refusal_of(""), HasSubstr("is empty"));
  EXPECT_EQ(read_number_rows("/nonexistent/a").error().code, ErrorCode::kNotFound);
}

TEST(NumberRows, HoldStampsToTheMicrosecond) {
  NumberRow row{.line = 7};
  row.value[1] = 1627252327.515387;
  EXPECT_EQ(stamp_in(row, 1, "a.tum")->time_since_epoch(), microseconds(1'627'252'327'515'387));
  row.value[1] = -0.25;
  EXPECT_EQ(stamp_in(row, 1, "a.tum")->time_since_epoch(), microseconds(-250'000));
  row.value[1] = 1627252327515387000.0;
  EXPECT_THAT(stamp_in(row, 1, "a.tum").error().message, EndsWith("is no stamp in seconds"));
  EXPECT_THAT(stamp_in(row, 1, "a.tum").error().message, testing::StartsWith("a.tum:7: column 2, "));
}

}  // namespace
}  // namespace swiftlet
