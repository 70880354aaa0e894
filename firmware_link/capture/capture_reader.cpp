// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_reader.hpp"

#include <algorithm>
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

constexpr std::size_t kMaxPossibleRecord = 65535;
constexpr std::size_t kMaxUnpackedBytes = 1'000'000'000;
constexpr std::size_t kMaxKnownRecord = record_prefix(CaptureLinkKind::kUsb) + kMaxCrtpPacket;
constexpr std::size_t kBuffer = 65536;
// Between the headers of two records that are interleaved; a stamp may be that of its minute alone.
constexpr std::int64_t kMaxApartS = 60;
constexpr std::size_t kMaxNamedDamages = 5;

std::optional<CaptureLinkKind> kind_of(std::uint8_t byte) {
  if (byte == static_cast<std::uint8_t>(CaptureLinkKind::kRadio)) return CaptureLinkKind::kRadio;
  if (byte == static_cast<std::uint8_t>(CaptureLinkKind::kUsb)) return CaptureLinkKind::kUsb;
  return std::nullopt;
}

Error nothing_yet() { return {ErrorCode::kTimeout, "no packet"}; }

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
  const std::span<const std::uint8_t> header = peek(0, kPcapFileHeader);
  offset_ = header.size();
  if (header.size() < kPcapFileHeader)
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
    if (const std::optional<Error> stop = pending_.empty() ? read_header() : read_body()) return *stop;
    if (found_) return *std::exchange(found_, std::nullopt);
  }
}

/// An error: nothing can be read on.
std::optional<Error> CaptureReader::read_header() {
  if (offset_ == size_) return end_of_capture();
  const std::optional<Header> header = header_at(offset_);
  if (!header) return unfinished("the file ends inside a record header");
  pending_.push_back(*header);
  offset_ += kPcapRecordHeader;
  const bool is_cut = header->length != header->original && header->length <= kMaxKnownRecord;
  if (header->length > kMaxPossibleRecord || header->length > header->original || is_cut)
    return resynchronise("the length of a record is impossible");
  if (header->fraction_ns >= 1'000'000'000) return resynchronise("the time of a record is impossible");
  return std::nullopt;
}

std::optional<Error> CaptureReader::read_body() {
  if (pending_.size() == 1 && is_interleaved()) return read_header();
  const Header& first = pending_.front();
  if (first.length > size_ - offset_) return unfinished("the file ends inside a record");
  if (pending_.size() == 1) {
    const bool is_known = looks_like_body(offset_);
    if (grows_ && !is_known && size_ - offset_ < kPcapRecordHeader) return unfinished("");  // a half header?
    if (is_known && first.length > kMaxKnownRecord)
      return resynchronise("a record is longer than a CRTP packet");
    take_body(0);
    return std::nullopt;
  }
  const std::size_t both = first.length + pending_.back().length;
  if (grows_ && size_ - offset_ < both + kPcapRecordHeader)
    return unfinished("");  // what follows decides, too
  const std::optional<std::size_t> owner = owner_of_body();
  if (owner) {
    take_body(*owner);
    return std::nullopt;
  }
  return both <= size_ - offset_ ? resynchronise("two headers without a record")
                                 : unfinished("the file ends inside a record");
}

/// Whether what should be the body of a record is the header of another one of the same moment.
bool CaptureReader::is_interleaved() {
  const std::optional<Header> next = certain_header_at(offset_);
  if (!next) return false;
  const std::int64_t apart_s = next->seconds - pending_.front().seconds;
  return apart_s <= kMaxApartS && -apart_s <= kMaxApartS;
}

/// Which of the two headers the next body belongs to. nullopt: neither, as far as is there.
std::optional<std::size_t> CaptureReader::owner_of_body() {
  if (!looks_like_body(offset_)) return std::nullopt;
  for (std::size_t i = 0; i < pending_.size(); ++i)
    if (looks_like_body(offset_ + pending_[i].length)) return i;
  for (std::size_t i = 0; i < pending_.size(); ++i)
    if (certain_header_at(offset_ + pending_[i].length)) return i;
  return std::nullopt;
}

void CaptureReader::take_body(std::size_t owner) {
  const Header header = pending_[owner];
  const std::span<const std::uint8_t> body = peek(offset_, std::min(header.length, kMaxKnownRecord));
  if (body.size() == header.length) found_ = parse_record(body);
  if (found_)
    found_->frame.at = HostTime(std::chrono::seconds(header.seconds) + Duration(header.fraction_ns));
  else
    ++skipped_;
  offset_ += header.length;
  pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(owner));
}

/// Reads on behind the damage that begins at the first header without a body. An error: there is nothing, or
/// not yet.
std::optional<Error> CaptureReader::resynchronise(const char* fault) {
  const std::uint64_t begin = pending_.front().at;
  offset_ = begin;
  pending_.clear();
  const std::optional<std::uint64_t> end = find_record(begin + 1);
  if (!end) return grows_ ? nothing_yet() : damaged(fault);
  if (!damages_.empty() && damages_.back().end == begin)
    damages_.back().end = *end;
  else
    damages_.push_back({begin, *end});
  offset_ = *end;
  return std::nullopt;
}

std::optional<std::uint64_t> CaptureReader::find_record(std::uint64_t from) {
  for (std::uint64_t at = std::max(from, searched_to_); at + kPcapRecordHeader < size_; ++at) {
    const std::optional<Header> header = certain_header_at(at);
    const std::uint64_t body_at = at + kPcapRecordHeader;
    if (header && (looks_like_body(body_at) || certain_header_at(body_at))) return at;
    if (body_at + kPcapRecordHeader <= size_) searched_to_ = at + 1;  // behind, more bytes may tell more
  }
  return std::nullopt;
}

/// At a place where the rest of a record is missing. A wrong length may reach beyond the end, too.
std::optional<Error> CaptureReader::unfinished(const char* what) {
  if (!grows_ && !pending_.empty()) return resynchronise(what);
  return grows_ ? nothing_yet() : damaged(what);
}

Error CaptureReader::end_of_capture() const {
  if (grows_) return nothing_yet();
  if (is_gzip_damaged_) return damaged("the gzip stream is cut off or garbled");
  if (damages_.empty()) return {ErrorCode::kEndOfRecording, path_ + ": end of the capture"};
  return {ErrorCode::kDamaged, path_ + ": damaged" + left_out() + "; the rest is used"};
}

/// A file that has shrunk is read as it was.
void CaptureReader::look_for_growth() {
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(path_, failure);
  if (failure || size <= size_) return;
  size_ = size;
  buffer_.clear();
}

void CaptureReader::rewind() {
  offset_ = kPcapFileHeader;
  pending_.clear();
  searched_to_ = 0;
  damages_.clear();
  skipped_ = 0;
}

std::uint32_t CaptureReader::load(std::span<const std::uint8_t> bytes, std::size_t at) const {
  return static_cast<std::uint32_t>(big_endian_ ? load_big_endian(bytes, at, 4)
                                                : load_little_endian(bytes, at, 4));
}

Error CaptureReader::damaged(const std::string& what) const {
  const std::string but = damages_.empty() ? "" : ", but for what is damaged" + left_out();
  return {ErrorCode::kDamaged, path_ + ": damaged at byte " + std::to_string(offset_) + " of " +
                                   std::to_string(size_) + ": " + what + "; what precedes it is used" + but};
}

/// " from byte 120 to 190, 300 to 340": what was passed over.
std::string CaptureReader::left_out() const {
  std::string text = " from byte ";
  for (std::size_t i = 0; i < std::min(damages_.size(), kMaxNamedDamages); ++i)
    text +=
        (i == 0 ? "" : ", ") + std::to_string(damages_[i].begin) + " to " + std::to_string(damages_[i].end);
  if (damages_.size() <= kMaxNamedDamages) return text;
  return text + " and in " + std::to_string(damages_.size() - kMaxNamedDamages) + " more places";
}

/// The bytes from there on, as many as there are; valid until the next call.
std::span<const std::uint8_t> CaptureReader::peek(std::uint64_t at, std::size_t size) {
  if (at >= size_) return {};
  const std::uint64_t end = std::min<std::uint64_t>(at + size, size_);
  if (at < buffer_at_ || end > buffer_at_ + buffer_.size()) {
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBuffer, size_ - at)));
    file_->clear();
    file_->seekg(static_cast<std::streamoff>(at));
    // iostreams read chars; the bytes are the same.
    file_->read(reinterpret_cast<char*>(buffer_.data()), static_cast<std::streamsize>(buffer_.size()));
    buffer_.resize(static_cast<std::size_t>(file_->gcount()));
    buffer_at_ = at;
  }
  const std::span<const std::uint8_t> from_there = std::span(buffer_).subspan(at - buffer_at_);
  return from_there.first(std::min<std::size_t>(from_there.size(), static_cast<std::size_t>(end - at)));
}

std::optional<CaptureReader::Header> CaptureReader::header_at(std::uint64_t at) {
  const std::span<const std::uint8_t> bytes = peek(at, kPcapRecordHeader);
  if (bytes.size() < kPcapRecordHeader) return std::nullopt;
  return Header{.at = at,
                .seconds = load(bytes, 0),
                .fraction_ns = tick_ns_ * std::int64_t{load(bytes, 4)},
                .length = load(bytes, 8),
                .original = load(bytes, 12)};
}

/// One of a record that holds a packet, by its lengths: sixteen other bytes are not taken for it.
std::optional<CaptureReader::Header> CaptureReader::certain_header_at(std::uint64_t at) {
  const std::optional<Header> header = header_at(at);
  const bool is_certain = header && header->length == header->original && header->length <= kMaxKnownRecord &&
                          header->length > record_prefix(CaptureLinkKind::kRadio) &&
                          header->fraction_ns < 1'000'000'000;
  return is_certain ? header : std::nullopt;
}

bool CaptureReader::looks_like_body(std::uint64_t at) {
  const std::span<const std::uint8_t> bytes = peek(at, 2);
  return bytes.size() == 2 && kind_of(bytes[0]) && bytes[1] <= 1;
}

}  // namespace swiftlet
