// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

struct WholeRead {
  std::vector<CaptureRecord> records;
  Error end;
};
WholeRead read_all(const std::string& path) {
  WholeRead reading;
  Result<CaptureReader> reader = CaptureReader::open(path);
  if (!reader) {
    reading.end = reader.error();
    return reading;
  }
  for (;;) {
    const Result<CaptureRecord> record = reader->next();
    if (!record) {
      reading.end = record.error();
      EXPECT_EQ(reader->next().error().message, reading.end.message);
      return reading;
    }
    reading.records.push_back(*record);
  }
}

constexpr const char* kHeader = "d4 c3 b2 a1 02 00 04 00 00 00 00 00 00 00 00 00 ff ff 00 00 a2 00 00 00";

TEST(CaptureReader, ReadsARadioRecord) {
  const TemporaryFile file(
      "a.pcap", as_text(hex(std::string(kHeader) + "61 e6 fd 60 b8 db 07 00 0e 00 00 00 0e 00 00 00"
                                                   "01 01 e7 e7 e7 e7 01 50 00 52 01 8e 11 00")));
  const WholeRead reading = read_all(file.path());
  ASSERT_EQ(reading.records.size(), 1U);
  const CaptureRecord& record = reading.records[0];
  EXPECT_EQ(record.vehicle, radio_vehicle(0x01));
  EXPECT_EQ(record.frame.direction, LinkDirection::kFromVehicle);
  EXPECT_EQ(record.frame.at, host_ms(1'627'252'321'515));
  EXPECT_THAT(record.frame.packet(), ElementsAreArray(hex("52 01 8e 11 00")));
  EXPECT_EQ(reading.end.code, ErrorCode::kEndOfRecording);
}

TEST(CaptureReader, ReadsAUsbRecord) {
  const TemporaryFile file(
      "a.pcap", as_text(hex(std::string(kHeader) + "61 e6 fd 60 b8 db 07 00 11 00 00 00 11 00 00 00"
                                                   "02 00 00 01 02 03 04 05 06 07 08 09 0a 0b 00 00 ff")));
  const WholeRead reading = read_all(file.path());
  ASSERT_EQ(reading.records.size(), 1U);
  EXPECT_EQ(reading.records[0].vehicle.text(), "usb 000102030405060708090A0B");
  EXPECT_EQ(reading.records[0].frame.direction, LinkDirection::kToVehicle);
  EXPECT_THAT(reading.records[0].frame.packet(), ElementsAreArray(hex("ff")));
}

TEST(CaptureReader, ReadsBigEndianAndNanoseconds) {
  const TemporaryFile file(
      "a.pcap", as_text(hex("a1 b2 3c 4d 00 02 00 04 00 00 00 00 00 00 00 00 00 00 ff ff 00 00 00 a2"
                            "60 fd e6 61 1e b3 3b 87 00 00 00 0a 00 00 00 0a"
                            "01 00 e7 e7 e7 e7 e7 50 00 ff")));
  const WholeRead reading = read_all(file.path());
  ASSERT_EQ(reading.records.size(), 1U) << reading.end.message;
  EXPECT_EQ(reading.records[0].frame.at, HostTime(std::chrono::nanoseconds(1'627'252'321'515'062'663)));
}

TEST(CaptureReader, SkipsRecordsWithoutAPacket) {
  const TemporaryFile file(
      "a.pcap", as_text(hex(std::string(kHeader) + "00 00 00 00 00 00 00 00 03 00 00 00 03 00 00 00"
                                                   "07 01 02"
                                                   "00 00 00 00 00 00 00 00 09 00 00 00 09 00 00 00"
                                                   "01 01 e7 e7 e7 e7 e7 50 00"
                                                   "00 00 00 00 00 00 00 00 0a 00 00 00 0a 00 00 00"
                                                   "01 00 e7 e7 e7 e7 e7 50 00 ff")));
  Result<CaptureReader> reader = CaptureReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader->next().ok());
  EXPECT_EQ(reader->skipped(), 2U);
  EXPECT_EQ(reader->next().error().code, ErrorCode::kEndOfRecording);
}

TEST(CaptureReader, TruncatedAnywhereItYieldsAllThatPrecedesTheEnd) {
  SyntheticCapture capture;
  capture.packets = 3;
  const std::vector<LinkFrame> frames = capture.frames();
  const TemporaryFile whole("whole.pcap");
  write_capture(whole.path(), frames);
  const std::string bytes = whole.read();
  std::vector<std::size_t> ends{kPcapFileHeader};  // where each record ends
  for (const LinkFrame& frame : frames)
    ends.push_back(ends.back() + kPcapRecordHeader + record_prefix(CaptureLinkKind::kRadio) + frame.size);
  ASSERT_EQ(ends.back(), bytes.size());

  const TemporaryFile cut("cut.pcap");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    cut.write(std::string_view(bytes).substr(0, length));
    const WholeRead reading = read_all(cut.path());
    const auto complete = std::upper_bound(ends.begin(), ends.end(), length) - ends.begin() - 1;
    if (length < kPcapFileHeader) {
      EXPECT_EQ(reading.end.code, ErrorCode::kInvalidInput);
      continue;
    }
    ASSERT_EQ(reading.records.size(), static_cast<std::size_t>(complete)) << "cut at " << length;
    const std::size_t last_end = ends[static_cast<std::size_t>(complete)];
    if (last_end == length) {
      EXPECT_EQ(reading.end.code, ErrorCode::kEndOfRecording);
    } else {
      EXPECT_EQ(reading.end.code, ErrorCode::kDamaged);
      EXPECT_THAT(reading.end.message, HasSubstr("damaged at byte " + std::to_string(last_end) + " of "));
    }
  }
}

std::string gzip_of(const std::string& bytes) {
  const TemporaryFile packed("packed");
  gzFile file = gzopen(packed.path().c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return packed.read();
}

TEST(CaptureReader, ReadsACaptureInGzipAndTellsWhereItIsCutOff) {
  SyntheticCapture capture;
  const TemporaryFile plain("plain.pcap");
  write_capture(plain.path(), capture.frames());
  const std::string packed = gzip_of(plain.read());
  const TemporaryFile whole("whole.pcap.gz", packed);
  const WholeRead reading = read_all(whole.path());
  EXPECT_EQ(reading.records.size(), read_all(plain.path()).records.size());
  EXPECT_EQ(reading.end.code, ErrorCode::kEndOfRecording);
  const TemporaryFile cut("cut.pcap.gz", packed.substr(0, packed.size() - 6));  // its checksum
  EXPECT_EQ(read_all(cut.path()).end.code, ErrorCode::kDamaged);
  EXPECT_THAT(read_all(cut.path()).end.message, HasSubstr("the gzip stream is cut off or garbled"));
  const TemporaryFile other("other.pcap.gz", gzip_of("no capture, and long enough for a header"));
  EXPECT_THAT(read_all(other.path()).end.message, HasSubstr("not a classic pcap capture"));
}

TEST(CaptureReader, ReportsImpossibleRecordsAsDamage) {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"00 00 00 00 00 00 00 00 0b 00 00 00 0a 00 00 00", "length"},
      {"00 00 00 00 00 00 00 00 00 00 01 00 00 00 01 00", "length"},
      {"00 00 00 00 40 42 0f 00 0a 00 00 00 0a 00 00 00", "time"},
      {"00 00 00 00 00 00 00 00 64 00 00 00 64 00 00 00", "ends inside"}};
  for (const auto& [record, fault] : cases) {
    const TemporaryFile file("bad.pcap",
                             as_text(hex(std::string(kHeader) + record + "01 00 e7 e7 e7 e7 e7 50 00 ff")));
    const WholeRead reading = read_all(file.path());
    EXPECT_EQ(reading.end.code, ErrorCode::kDamaged) << record;
    EXPECT_THAT(reading.end.message, HasSubstr(fault)) << record;
    EXPECT_THAT(reading.end.message, HasSubstr("byte 24 of 50")) << record;
  }
}

TEST(CaptureReader, NoCorruptionMakesItFail) {
  const TemporaryFile whole("whole.pcap");
  write_capture(whole.path(), SyntheticCapture{}.frames());
  const std::string bytes = whole.read();
  const TemporaryFile corrupt("corrupt.pcap");
  std::mt19937 random(20);
  for (int round = 0; round < 500; ++round) {
    std::string mutated = bytes;
    for (int i = 0; i < 1 + round % 5; ++i)
      mutated[random() % mutated.size()] = static_cast<char>(random() & 0xFF);
    corrupt.write(mutated);
    const WholeRead reading = read_all(corrupt.path());
    EXPECT_LE(reading.records.size(), SyntheticCapture{}.frames().size() + 1);
    EXPECT_FALSE(reading.end.message.empty());
  }
}

/// The bytes of one record as the vendor's USB driver writes it, in two pieces.
struct UsbRecord {
  std::string header;
  std::string body;
  Bytes packet;
};

UsbRecord usb_record(std::uint8_t seconds, const std::string& packet) {
  UsbRecord record{.header = {}, .body = {}, .packet = hex(packet)};
  const auto length = static_cast<std::uint8_t>(16 + record.packet.size());
  record.header = as_text({seconds, 0, 0, 0, 5, 0, 0, 0, length, 0, 0, 0, length, 0, 0, 0});
  record.body = as_text(hex("02 01 30 00 1f 00 11 51 33 33 38 34 39 35 00 02")) + as_text(record.packet);
  return record;
}

std::vector<Bytes> packets_of(const WholeRead& reading) {
  std::vector<Bytes> packets;
  for (const CaptureRecord& record : reading.records)
    packets.emplace_back(record.frame.packet().begin(), record.frame.packet().end());
  return packets;
}

struct InterleavedCapture {
  std::string bytes;
  std::vector<Bytes> packets;
};

/// Two records in each order of their pieces; in the last, the one thread writes its next record while the
/// other has written half of its own.
std::vector<InterleavedCapture> interleaved_captures() {
  // Seconds 1 and 2 look like the beginning of a body.
  const UsbRecord a = usb_record(2, "52 01 8e 11 00 aa");
  const UsbRecord b = usb_record(1, "ff");
  const UsbRecord c = usb_record(2, "52 01 f2 11 00 bb");
  const std::string begin = as_text(hex(kHeader)) + c.header + c.body;
  const std::string end = c.header + c.body;
  std::vector<InterleavedCapture> captures;
  for (const std::string& middle :
       {a.header + b.header + a.body + b.body, a.header + b.header + b.body + a.body,
        b.header + a.header + a.body + b.body, b.header + a.header + b.body + a.body})
    captures.push_back(
        {std::string(begin).append(middle).append(end), {a.packet, b.packet, c.packet, c.packet}});
  captures.push_back({begin + a.header + b.header + a.body + c.header + b.body + c.body + end,
                      {a.packet, b.packet, c.packet, c.packet, c.packet}});
  return captures;
}

TEST(CaptureReader, ReadsRecordsThatTwoThreadsHaveInterleaved) {
  const TemporaryFile file("a.pcap");
  for (const InterleavedCapture& capture : interleaved_captures()) {
    file.write(capture.bytes);
    const WholeRead reading = read_all(file.path());
    EXPECT_EQ(reading.end.code, ErrorCode::kEndOfRecording) << reading.end.message;
    EXPECT_THAT(packets_of(reading), UnorderedElementsAreArray(capture.packets));
  }
}

/// The packets of a file that grows by one byte at a time.
std::vector<Bytes> followed(const std::string& bytes) {
  const TemporaryFile file("growing.pcap", bytes.substr(0, kPcapFileHeader));
  Result<CaptureReader> reader = CaptureReader::open(file.path());
  EXPECT_TRUE(reader.ok());
  if (!reader) return {};
  reader->follow();
  std::vector<Bytes> packets;
  for (std::size_t size = kPcapFileHeader; size <= bytes.size(); ++size) {
    file.write(bytes.substr(0, size));
    Result<CaptureRecord> record = reader->next();
    for (; record; record = reader->next())
      packets.emplace_back(record->frame.packet().begin(), record->frame.packet().end());
    EXPECT_EQ(record.error().code, ErrorCode::kTimeout) << "byte " << size << ": " << record.error().message;
  }
  return packets;
}

TEST(CaptureReader, FollowsRecordsThatAreInterleavedWhereverTheFileEnds) {
  for (const InterleavedCapture& capture : interleaved_captures())
    EXPECT_THAT(followed(capture.bytes), UnorderedElementsAreArray(capture.packets));
}

TEST(CaptureReader, FollowsBehindDamage) {
  const UsbRecord a = usb_record(2, "52 01 8e 11 00 aa");
  const std::string damage(200, '\xEE');
  EXPECT_THAT(
      followed(as_text(hex(kHeader)) + a.header + a.body + damage + a.header + a.body + a.header + a.body),
      ElementsAre(a.packet, a.packet, a.packet));
}

TEST(CaptureReader, ReadsOnBehindDamageAndNamesTheBytesLeftOut) {
  const std::vector<LinkFrame> frames = SyntheticCapture{}.frames();
  const TemporaryFile whole("whole.pcap");
  write_capture(whole.path(), frames);
  const std::string bytes = whole.read();
  std::vector<std::size_t> begins{kPcapFileHeader};
  for (const LinkFrame& frame : frames)
    begins.push_back(begins.back() + kPcapRecordHeader + record_prefix(CaptureLinkKind::kRadio) + frame.size);
  const std::string range = std::to_string(begins[4]) + " to " + std::to_string(begins[5]);

  const TemporaryFile file("damaged.pcap");
  for (const std::size_t byte : {8U, 9U, 11U, 12U, 7U}) {  // of a record's header: lengths and time
    std::string damaged = bytes;
    damaged[begins[4] + byte] = '\x7f';
    file.write(damaged);
    const WholeRead reading = read_all(file.path());
    EXPECT_EQ(reading.records.size(), frames.size() - 1) << byte;
    EXPECT_EQ(reading.end.code, ErrorCode::kDamaged);
    EXPECT_THAT(reading.end.message, HasSubstr("from byte " + range)) << byte;
  }
  file.write(bytes.substr(0, begins[6]) + "seven b" + bytes.substr(begins[6]));
  const WholeRead reading = read_all(file.path());
  EXPECT_EQ(reading.records.size(), frames.size());
  EXPECT_THAT(reading.end.message,
              HasSubstr("from byte " + std::to_string(begins[6]) + " to " + std::to_string(begins[6] + 7)));
}

TEST(CaptureReader, ReportsWhyAFileIsNoCapture) {
  const TemporaryFile text("notes.txt", "These are not the bytes of a capture.");
  EXPECT_THAT(read_all(text.path()).end.message, HasSubstr("not a classic pcap"));
  const TemporaryFile ethernet(
      "eth.pcap", as_text(hex("d4 c3 b2 a1 02 00 04 00 00 00 00 00 00 00 00 00 ff ff 00 00 01 00 00 00")));
  EXPECT_THAT(read_all(ethernet.path()).end.message, HasSubstr("link type 1,"));
  const TemporaryFile brief("brief.pcap", "\xD4\xC3\xB2\xA1");
  EXPECT_THAT(read_all(brief.path()).end.message, HasSubstr("4 bytes, too short"));
}

}  // namespace
}  // namespace swiftlet
