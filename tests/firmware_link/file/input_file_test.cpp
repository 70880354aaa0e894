// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(InputFile, ReturnsTheSizeOfAFile) {
  const TemporaryFile file("a", "12345");
  const auto size = size_of_input_file(file.path());
  ASSERT_TRUE(size.ok());
  EXPECT_EQ(*size, 5U);
}

TEST(InputFile, ReportsWhyAPathCannotBeRead) {
  EXPECT_EQ(size_of_input_file("/nonexistent/a").error().code, ErrorCode::kNotFound);
  EXPECT_THAT(size_of_input_file("/nonexistent/a").error().message,
              HasSubstr("/nonexistent/a: no such file"));
  EXPECT_THAT(size_of_input_file(testing::TempDir()).error().message, HasSubstr("is a directory"));
  EXPECT_THAT(size_of_input_file("/dev/null").error().message, HasSubstr("not a regular file"));
  const TemporaryFile empty("empty", "");
  EXPECT_THAT(size_of_input_file(empty.path()).error().message, HasSubstr("is empty"));
}

TEST(InputFile, DetectsACaptureByItsFirstBytes) {
  EXPECT_TRUE(begins_like_capture(TemporaryFile("classic", "\xD4\xC3\xB2\xA1 and more").path()));
  EXPECT_TRUE(begins_like_capture(TemporaryFile("next_generation", "\n\r\r\n").path()));
  const TemporaryFile packed("packed.pcap.gz");
  gzFile file = gzopen(packed.path().c_str(), "wb");
  gzwrite(file, "\xD4\xC3\xB2\xA1 and more", 13);
  gzclose(file);
  EXPECT_TRUE(begins_like_capture(packed.path()));
  EXPECT_FALSE(begins_like_capture(TemporaryFile("laser_log", "FLASER 180").path()));
  EXPECT_FALSE(begins_like_capture(TemporaryFile("short.pcap", "\xD4\xC3").path()));
  EXPECT_FALSE(begins_like_capture("/nonexistent/a.pcap"));
}

TEST(InputFile, ReportsMissingPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryFile secret("secret", "x");
  std::filesystem::permissions(secret.path(), std::filesystem::perms::none);
  EXPECT_THAT(size_of_input_file(secret.path()).error().message, HasSubstr("permission"));
}

}  // namespace
}  // namespace swiftlet
