// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/capture/capture_format.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

struct CaptureRecord {
  CaptureVehicle vehicle;
  LinkFrame frame;
};

/// Reads a capture record by record, in either byte order, with stamps in microseconds or nanoseconds. One in
/// gzip is unpacked into memory first; offsets are those in the capture. One thread at a time.
class CaptureReader {
 public:
  /// Errors: kNotFound: no such file. kInvalidInput: a directory, unreadable, empty, or not such a capture.
  [[nodiscard]] static Result<CaptureReader> open(const std::string& path);

  /// The next record that holds a packet. Errors: kEndOfRecording. kDamaged: truncated or corrupt; the
  /// message names the byte offset, and every later call returns the same error.
  [[nodiscard]] Result<CaptureRecord> next();
  /// The file is still written: where it ends at present, even inside a record, next() returns kTimeout and
  /// reads on at the next call. One in gzip is read as it is.
  void follow() { grows_ = !is_gzip_; }
  /// Back to the first record.
  void rewind();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes read so far, and in all.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Records skipped: of an unknown kind, or too short to hold a packet.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  CaptureReader() = default;
  Status open_file();
  Status read_file_header();
  [[nodiscard]] std::uint32_t load(std::span<const std::uint8_t> bytes, std::size_t at) const;
  [[nodiscard]] Error ends(const Error& otherwise) const;
  void look_for_growth();
  [[nodiscard]] Error damaged(const std::string& what) const;
  bool read_exactly(std::span<std::uint8_t> bytes);

  std::string path_;
  std::unique_ptr<std::istream> file_;
  bool is_gzip_ = false;
  bool is_gzip_damaged_ = false;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t skipped_ = 0;
  bool grows_ = false;
  bool big_endian_ = false;
  std::int64_t tick_ns_ = 1000;  ///< of the fraction in a record's time
};

}  // namespace swiftlet
