// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <span>
#include <system_error>
#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kBufferSize = 65'536;
constexpr std::size_t kMaxWrittenRecord =
    kPcapRecordHeader + record_prefix(CaptureLinkKind::kUsb) + kMaxCrtpPacket;
constexpr mode_t kEverybodyMayRead = 0644;

std::string text_of_error(int error_number) { return std::generic_category().message(error_number); }

/// How many of `bytes` were written; if not all, errno holds the reason.
std::size_t write_all(int file, std::span<const std::uint8_t> bytes) {
  std::size_t taken = 0;
  while (taken < bytes.size()) {
    const ssize_t written = ::write(file, bytes.data() + taken, bytes.size() - taken);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    taken += static_cast<std::size_t>(written);
  }
  return taken;
}

/// Bytes of the complete records at the start of `records`, of which only `taken` bytes were written.
std::size_t whole_records(std::span<const std::uint8_t> records, std::size_t taken) {
  std::size_t whole = 0;
  while (whole + kPcapRecordHeader <= taken) {
    const std::size_t next = whole + kPcapRecordHeader + load_u32(records, whole + 8);
    if (next > taken) break;
    whole = next;
  }
  return whole;
}

}  // namespace

Result<CaptureWriter> CaptureWriter::create(const std::string& path, const CaptureVehicle& vehicle) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kEverybodyMayRead);
  if (file < 0 && errno == EEXIST)
    return Error{ErrorCode::kInvalidInput, path + ": is there already; choose another name or remove it"};
  if (file < 0)
    return Error{ErrorCode::kInvalidInput,
                 path + ": cannot be written: " + text_of_error(errno) + "; name another file"};
  static_cast<void>(
      ::flock(file, LOCK_EX | LOCK_NB));  // advisory: without the lock the file is written anyway
  CaptureWriter writer(path, vehicle, file);
  writer.put_file_header();
  const Status written = writer.flush();
  if (written) return writer;
  ::unlink(path.c_str());  // just created, and empty
  return written.error();
}

CaptureWriter::CaptureWriter(std::string path, const CaptureVehicle& vehicle, int file)
    : path_(std::move(path)), vehicle_(vehicle), file_(file) {
  buffer_.reserve(kBufferSize);
}

CaptureWriter::CaptureWriter(CaptureWriter&& other) noexcept
    : path_(std::move(other.path_)),
      vehicle_(other.vehicle_),
      file_(std::exchange(other.file_, -1)),
      buffer_(std::move(other.buffer_)),
      stored_(other.stored_),
      failure_(std::move(other.failure_)) {}

CaptureWriter::~CaptureWriter() {
  if (file_ < 0) return;
  static_cast<void>(flush());
  ::close(file_);
}

void CaptureWriter::put_u32(std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) put(low_byte(value >> shift));
}

void CaptureWriter::put_file_header() {
  put_u32(kPcapMagicMicroseconds);
  put_u32(0x00040002);  // version 2.4
  put_u32(0);           // time zone
  put_u32(0);           // accuracy
  put_u32(65535);       // longest record
  put_u32(kPcapLinkType);
}

Status CaptureWriter::write(const LinkFrame& frame) {
  SWIFTLET_CHECK(frame.size <= kMaxCrtpPacket, "a frame holds one CRTP packet");
  if (buffer_.size() + kMaxWrittenRecord > kBufferSize) {
    if (Status flushed = flush(); !flushed) return flushed;
  }
  if (failure_) return *failure_;
  const auto microseconds =
      std::chrono::floor<std::chrono::microseconds>(frame.at.time_since_epoch()).count();
  const auto length = static_cast<std::uint32_t>(record_prefix(vehicle_.kind) + frame.size);
  put_u32(static_cast<std::uint32_t>(microseconds / 1'000'000));
  put_u32(static_cast<std::uint32_t>(microseconds % 1'000'000));
  put_u32(length);
  put_u32(length);
  put(static_cast<std::uint8_t>(vehicle_.kind));
  put(frame.direction == LinkDirection::kFromVehicle ? 1 : 0);
  for (std::size_t i = 0; i < address_size(vehicle_.kind); ++i) put(vehicle_.address[i]);
  put(vehicle_.channel);
  put(0);  // index of the dongle, or port number
  for (const std::uint8_t byte : frame.packet()) put(byte);
  return {};
}

Status CaptureWriter::flush() {
  if (failure_) return *failure_;
  const std::size_t taken = write_all(file_, buffer_);
  if (taken < buffer_.size()) return fail(errno, taken);
  stored_ += taken;
  buffer_.clear();
  return {};
}

Status CaptureWriter::fail(int error_number, std::size_t taken) {
  // The file holds an incomplete header only.
  const bool has_header = stored_ > 0;
  stored_ += has_header ? whole_records(buffer_, taken) : 0;
  buffer_.clear();
  // If even this fails, a reader reports the last record as truncated.
  static_cast<void>(::ftruncate(file_, static_cast<off_t>(stored_)));
  failure_ = Error{ErrorCode::kOutOfSpace,
                   path_ + ": cannot be written any further: " + text_of_error(error_number)};
  return *failure_;
}

Status CaptureWriter::close() {
  if (file_ < 0) return {};
  if (Status flushed = flush(); !flushed) return flushed;
  // EINVAL: a special file without a disk behind it.
  if (::fdatasync(file_) != 0 && errno != EINVAL) return fail(errno, 0);
  ::close(std::exchange(file_, -1));
  return {};
}

bool is_being_written(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0;
  ::close(file);
  return locked;
}

}  // namespace swiftlet
