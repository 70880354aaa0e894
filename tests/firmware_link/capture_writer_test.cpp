// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture_writer.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

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

TEST(CaptureWriter, SaysWhereItCannotWrite) {
  const Result<CaptureWriter> writer = CaptureWriter::create("/nonexistent/a.pcap", radio_vehicle(0xE7));
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(writer.error().message, "/nonexistent/a.pcap: cannot be written");
}

TEST(CaptureWriter, ReportsAFullDisk) {
  Result<CaptureWriter> writer = CaptureWriter::create("/dev/full", radio_vehicle(0xE7));
  if (!writer.ok()) GTEST_SKIP() << "no /dev/full here";
  const Status flushed = writer->flush();
  ASSERT_FALSE(flushed.ok());
  EXPECT_EQ(flushed.error().code, ErrorCode::kOutOfSpace);
}

}  // namespace
}  // namespace swiftlet
