// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_reader.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/file/gzip_file.hpp"
#include "firmware_link/file/input_file.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxRecord = 65535;
constexpr std::size_t kMaxUnpackedBytes = 1'000'000'000;
constexpr std::size_t kMaxKnownRecord = record_prefix(CaptureLinkKind::kUsb) + kMaxCrtpPacket;

std::optional<CaptureLinkKind> kind_of(std::uint8_t byte) {
  if (byte == static_cast<std::uint8_t>(CaptureLinkKind::kRadio)) return CaptureLinkKind::kRadio;
  if (byte == static_cast<std::uint8_t>(CaptureLinkKind::kUsb)) return CaptureLinkKind::kUsb;
  return std::nullopt;
}

/// nullopt if it holds no packet.
std::optional<CaptureRecord> parse_record(std::span<const std::uint8_t> bytes) {
  const std::optional<CaptureLinkKind> kind = bytes.empty() ? std::nullopt : kind_of(bytes[0]);
  if (!kind || bytes.size() <= record_prefix(*kind) || bytes[1] > 1) return std::nullopt;
  const std::span<const std::uint8_t> packet = bytes.subspan(record_prefix(*kind));
  if (packet.size() > kMaxCrtpPacket) return std::nullopt;
  CaptureRecord record;
  record.vehicle.kind = *kind;
  std::copy_n(bytes.begin() + 2, address_size(*kind), record.vehicle.address.begin());
  record.vehicle.channel = bytes[2 + address_size(*kind)];
  record.frame.direction = bytes[1] == 1 ? LinkDirection::kFromVehicle : LinkDirection::kToVehicle;
  record.frame.size = static_cast<std::uint8_t>(packet.size());
  std::copy(packet.begin(), packet.end(), record.frame.bytes.begin());
  return record;
}

}  // namespace

Result<CaptureReader> CaptureReader::open(const std::string& path) {
  const Result<std::uint64_t> size = size_of_input_file(path);
  if (!size) return size.error();
  CaptureReader reader;
  reader.path_ = path;
  reader.size_ = *size;
  if (Status opened = reader.open_file(); !opened) return opened.error();
  const Status read = reader.read_file_header();
  if (!read) return read.error();
  return reader;
}

Status CaptureReader::open_file() {
  is_gzip_ = begins_like_gzip(path_);
  if (!is_gzip_) {
    file_ = std::make_unique<std::ifstream>(path_, std::ios::binary);
    return {};
  }
  Result<UnpackedFile> unpacked = unpack_gzip(path_, kMaxUnpackedBytes);
  if (!unpacked) return unpacked.error();
  is_gzip_damaged_ = unpacked->is_damaged;
  size_ = unpacked->bytes.size();
  file_ = std::make_unique<std::istringstream>(std::move(unpacked->bytes));
  return {};
}

Status CaptureReader::read_file_header() {
  std::array<std::uint8_t, kPcapFileHeader> header{};
  if (!read_exactly(header))
    return Error{ErrorCode::kInvalidInput,
                 path_ + ": " + std::to_string(size_) + " bytes, too short for a capture (pcap needs 24)"};
  bool known = false;
  for (const bool big_endian : {false, true}) {
    big_endian_ = big_endian;
    const std::uint32_t magic = load(header, 0);
    known = magic == kPcapMagicMicroseconds || magic == kPcapMagicNanoseconds;
    tick_ns_ = magic == kPcapMagicNanoseconds ? 1 : 1000;
    if (known) break;
  }
  if (!known)
    return Error{ErrorCode::kInvalidInput,
                 path_ + ": not a classic pcap capture (its first four bytes differ)"};
  const std::uint32_t link_type = load(header, 20) & 0x0FFFFFFF;  // flags stand above
  if (link_type != kPcapLinkType)
    return Error{ErrorCode::kInvalidInput, path_ + ": pcap of link type " + std::to_string(link_type) +
                                               ", not a Crazyflie capture (162)"};
  return {};
}

Result<CaptureRecord> CaptureReader::next() {
  for (;;) {
    if (grows_) look_for_growth();
    if (offset_ == size_ && is_gzip_damaged_) return damaged("the gzip stream is cut off or garbled");
    if (offset_ == size_) return ends({ErrorCode::kEndOfRecording, path_ + ": end of the capture"});
    std::array<std::uint8_t, kPcapRecordHeader> header{};
    if (size_ - offset_ < header.size()) return ends(damaged("the file ends inside a record header"));
    const std::uint64_t record_start = offset_;
    if (!read_exactly(header)) return damaged("cannot be read");
    const std::int64_t fraction_ns = tick_ns_ * std::int64_t{load(header, 4)};
    const std::size_t length = load(header, 8);
    std::array<std::uint8_t, kMaxKnownRecord> bytes{};
    const std::span<std::uint8_t> body(bytes.data(), std::min(length, bytes.size()));
    const char* fault = nullptr;
    bool is_unfinished = false;
    if (length > kMaxRecord || length > load(header, 12)) {
      fault = "the length of a record is impossible";
    } else if (fraction_ns >= 1'000'000'000) {
      fault = "the time of a record is impossible";
    } else if (length > size_ - offset_) {
      fault = "the file ends inside a record";
      is_unfinished = true;
    } else if (!read_exactly(body)) {
      fault = "cannot be read";
    } else if (length > body.size() && kind_of(body[0])) {
      fault = "a record is longer than a CRTP packet";
    }
    if (fault != nullptr) {
      offset_ = record_start;
      file_->seekg(static_cast<std::streamoff>(offset_));
      return is_unfinished ? ends(damaged(fault)) : damaged(fault);
    }
    if (length > body.size()) {
      file_->seekg(static_cast<std::streamoff>(length - body.size()), std::ios::cur);
      offset_ += length - body.size();
    }
    std::optional<CaptureRecord> record = length > body.size() ? std::nullopt : parse_record(body);
    if (record) {
      record->frame.at = HostTime(std::chrono::seconds(load(header, 0)) + Duration(fraction_ns));
      return *record;
    }
    ++skipped_;
  }
}

Error CaptureReader::ends(const Error& otherwise) const {
  return grows_ ? Error{ErrorCode::kTimeout, "no packet"} : otherwise;
}

/// A file that has shrunk is read as it was.
void CaptureReader::look_for_growth() {
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(path_, failure);
  if (failure || size <= size_) return;
  size_ = size;
  file_->clear();
  file_->seekg(static_cast<std::streamoff>(offset_));
}

void CaptureReader::rewind() {
  file_->clear();
  offset_ = kPcapFileHeader;
  skipped_ = 0;
  file_->seekg(static_cast<std::streamoff>(offset_));
}

std::uint32_t CaptureReader::load(std::span<const std::uint8_t> bytes, std::size_t at) const {
  return static_cast<std::uint32_t>(big_endian_ ? load_big_endian(bytes, at, 4)
                                                : load_little_endian(bytes, at, 4));
}

Error CaptureReader::damaged(const std::string& what) const {
  return {ErrorCode::kDamaged, path_ + ": damaged at byte " + std::to_string(offset_) + " of " +
                                   std::to_string(size_) + ": " + what + "; what precedes it is used"};
}

bool CaptureReader::read_exactly(std::span<std::uint8_t> bytes) {
  // iostreams read chars; the bytes are the same.
  file_->read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file_->gcount() != static_cast<std::streamsize>(bytes.size())) return false;
  offset_ += bytes.size();
  return true;
}

}  // namespace swiftlet
