// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture_writer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>

#include "core/base/check.hpp"
#include "core/base/fixed_vector.hpp"
#include "firmware_link/crtp_packet.hpp"

namespace swiftlet {
namespace {

using RecordBytes =
    FixedVector<std::uint8_t, kPcapRecordHeader + record_prefix(CaptureLinkKind::kUsb) + kMaxCrtpPacket>;
static_assert(RecordBytes::capacity() >= kPcapFileHeader);

void put(RecordBytes& bytes, std::uint8_t byte) {
  const bool fits = bytes.try_push_back(byte);
  SWIFTLET_CHECK(fits, "a record fits its buffer");
}
void put_u32(RecordBytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) put(bytes, static_cast<std::uint8_t>((value >> shift) & 0xFF));
}

void write_all(std::ofstream& file, const RecordBytes& bytes) {
  // iostreams write chars; the bytes are the same.
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

Result<CaptureWriter> CaptureWriter::create(const std::string& path, const CaptureVehicle& vehicle) {
  CaptureWriter writer;
  writer.path_ = path;
  writer.vehicle_ = vehicle;
  writer.file_.open(path, std::ios::binary | std::ios::trunc);
  if (!writer.file_) return Error{ErrorCode::kInvalidInput, path + ": cannot be written"};
  RecordBytes header;
  put_u32(header, kPcapMagicMicroseconds);
  put_u32(header, 0x00040002);  // version 2.4
  put_u32(header, 0);           // time zone
  put_u32(header, 0);           // accuracy
  put_u32(header, 65535);       // longest record
  put_u32(header, kPcapLinkType);
  write_all(writer.file_, header);
  const Status written = writer.check();
  if (!written) return written.error();
  return writer;
}

Status CaptureWriter::write(const LinkFrame& frame) {
  SWIFTLET_CHECK(frame.size <= kMaxCrtpPacket, "a frame holds one CRTP packet");
  const auto microseconds =
      std::chrono::floor<std::chrono::microseconds>(frame.at.time_since_epoch()).count();
  const auto length = static_cast<std::uint32_t>(record_prefix(vehicle_.kind) + frame.size);
  RecordBytes bytes;
  put_u32(bytes, static_cast<std::uint32_t>(microseconds / 1'000'000));
  put_u32(bytes, static_cast<std::uint32_t>(microseconds % 1'000'000));
  put_u32(bytes, length);
  put_u32(bytes, length);
  put(bytes, static_cast<std::uint8_t>(vehicle_.kind));
  put(bytes, frame.direction == LinkDirection::kFromVehicle ? 1 : 0);
  for (std::size_t i = 0; i < address_size(vehicle_.kind); ++i) put(bytes, vehicle_.address[i]);
  put(bytes, vehicle_.channel);
  put(bytes, 0);  // index of the dongle, or port number
  for (const std::uint8_t byte : frame.packet()) put(bytes, byte);
  write_all(file_, bytes);
  return check();
}

Status CaptureWriter::flush() {
  file_.flush();
  return check();
}

Status CaptureWriter::check() const {
  if (file_) return {};
  return Error{ErrorCode::kOutOfSpace, path_ + ": cannot be written any further (disk full?)"};
}

}  // namespace swiftlet
