// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_writer.hpp"

#include <gmock/gmock.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "firmware_link/capture/capture_reader.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(CaptureWriter, WritesTheMeasuredLayoutOfARadioRecord) {
  const TemporaryFile file("radio.pcap");
  Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->write(sent(hex("ff"), host_ms(1'627'252'321'515))).ok());
  ASSERT_TRUE(writer->write(received(hex("52 01 8e 11 00"), host_ms(1'627'252'321'516))).ok());
  ASSERT_TRUE(writer->flush().ok());
  EXPECT_EQ(file.read(), as_text(hex("d4 c3 b2 a1 02 00 04 00 00 00 00 00 00 00 00 00 ff ff 00 00 a2 00 00 00"
                                     "61 e6 fd 60 b8 db 07 00 0a 00 00 00 0a 00 00 00"
                                     "01 00 e7 e7 e7 e7 e7 50 00 ff"
                                     "61 e6 fd 60 a0 df 07 00 0e 00 00 00 0e 00 00 00"
                                     "01 01 e7 e7 e7 e7 e7 50 00 52 01 8e 11 00")));
}

TEST(CaptureWriter, ReportsWhereItCannotWrite) {
  const Result<CaptureWriter> writer = CaptureWriter::create("/nonexistent/a.pcap", radio_vehicle(0xE7));
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(writer.error().message,
            "/nonexistent/a.pcap: cannot be written: No such file or directory; name another file");
}

TEST(CaptureWriter, RefusesAnExistingFileAndDoesNotChangeIt) {
  const TemporaryFile file("there.pcap", "mine");
  const Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(writer.error().message, HasSubstr("there.pcap: is there already"));
  EXPECT_EQ(file.read(), "mine");
}

TEST(CaptureWriter, ADiskThatIsFullFromTheStartIsReportedAndNoFileLeft) {
  const TemporaryFile file("full.pcap");
  const FileSizeLimit limit(23);
  const Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().code, ErrorCode::kOutOfSpace);
  EXPECT_THAT(writer.error().message, HasSubstr("full.pcap: cannot be written any further: "));
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

std::size_t frames_in(const std::string& path) {
  Result<CaptureReader> reader = CaptureReader::open(path);
  if (!reader) return 0;
  std::size_t frames = 0;
  Result<CaptureRecord> record = reader->next();
  for (; record; record = reader->next()) ++frames;
  EXPECT_EQ(record.error().code, ErrorCode::kEndOfRecording) << record.error().message;
  return frames;
}

TEST(CaptureWriter, WhatWasFlushedIsInTheFileAndTheRestFollowsWhenItIsClosed) {
  const TemporaryFile file("flushed.pcap");
  Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_TRUE(writer.ok());
  EXPECT_EQ(frames_in(file.path()), 0U);  // the header stands there at once
  ASSERT_TRUE(writer->write(received(hex("52 01 8e 11 00"))).ok());
  ASSERT_TRUE(writer->flush().ok());
  EXPECT_EQ(frames_in(file.path()), 1U);
  ASSERT_TRUE(writer->write(received(hex("52 01 8f 11 00"))).ok());
  EXPECT_EQ(frames_in(file.path()), 1U);
  ASSERT_TRUE(writer->close().ok());
  ASSERT_TRUE(writer->close().ok());
  EXPECT_EQ(frames_in(file.path()), 2U);
  EXPECT_EQ(writer->size(), std::filesystem::file_size(file.path()));
}

TEST(CaptureWriter, WritesMoreThanItsBufferHolds) {
  const TemporaryFile file("many.pcap");
  Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_TRUE(writer.ok());
  for (int i = 0; i < 10'000; ++i)
    ASSERT_TRUE(writer->write(received(hex("52 01 8e 11 00"), host_ms(i))).ok());
  ASSERT_TRUE(writer->close().ok());
  EXPECT_EQ(frames_in(file.path()), 10'000U);
}

TEST(CaptureWriter, TruncatesAPartialRecordWhenTheDiskIsFull) {
  constexpr rlim_t kRecord = 16 + 9 + 5;
  for (rlim_t spare = 0; spare < kRecord; ++spare) {  // wherever in a record the disk ends
    const TemporaryFile file("full.pcap");
    const FileSizeLimit limit(24 + 3 * kRecord + spare);
    Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(writer->write(received(hex("52 01 8e 11 00"))).ok());
    ASSERT_TRUE(writer->flush().ok());
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(writer->write(received(hex("52 01 8e 11 00"))).ok());
    const Status flushed = writer->flush();
    ASSERT_FALSE(flushed.ok());
    EXPECT_EQ(flushed.error().code, ErrorCode::kOutOfSpace);
    EXPECT_THAT(flushed.error().message, HasSubstr("full.pcap: cannot be written any further: "));
    EXPECT_EQ(frames_in(file.path()), 3U);
    EXPECT_EQ(writer->size(), 24 + 3 * kRecord);
    EXPECT_FALSE(writer->write(received(hex("52 01 8e 11 00"))).ok());
    EXPECT_FALSE(writer->close().ok());
  }
}

TEST(CaptureWriter, LocksItsFileUntilItIsClosed) {
  const TemporaryFile file("used.pcap");
  EXPECT_FALSE(is_being_written(file.path()));
  Result<CaptureWriter> writer = CaptureWriter::create(file.path(), radio_vehicle(0xE7));
  ASSERT_TRUE(writer.ok());
  EXPECT_TRUE(is_being_written(file.path()));
  ASSERT_TRUE(writer->close().ok());
  EXPECT_FALSE(is_being_written(file.path()));
}

}  // namespace
}  // namespace swiftlet
