// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/capture/capture_format.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

struct CaptureRecord {
  CaptureVehicle vehicle;
  LinkFrame frame;
};

/// Reads a capture record by record, in either byte order, with stamps in microseconds or nanoseconds. The
/// vendor's USB driver writes from two threads: where two records are interleaved (header, header, body,
/// body), both are read. Behind damage, it reads on at the next header whose record makes sense. A capture in
/// gzip is unpacked into memory first; offsets are those in the capture. One thread at a time; allocates.
class CaptureReader {
 public:
  /// Errors: kNotFound: no such file. kInvalidInput: a directory, unreadable, empty, or not such a capture.
  [[nodiscard]] static Result<CaptureReader> open(const std::string& path);

  /// The next record that holds a packet. Errors: kEndOfRecording. kDamaged: at the end of a file that is
  /// truncated or was damaged on the way; the message names the byte offsets of what is left out, and every
  /// later call returns the same error.
  [[nodiscard]] Result<CaptureRecord> next();
  /// The file is still written: where it ends at present, even inside a record or behind damage, next()
  /// returns kTimeout and reads on at the next call. One in gzip is read as it is.
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
  struct Header {
    std::uint64_t at = 0;  ///< its offset
    std::int64_t seconds = 0;
    std::int64_t fraction_ns = 0;
    std::size_t length = 0;    ///< of the body in the file
    std::size_t original = 0;  ///< by the record's header
  };
  struct DamagedBytes {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };

  CaptureReader() = default;
  Status open_file();
  Status read_file_header();
  [[nodiscard]] std::uint32_t load(std::span<const std::uint8_t> bytes, std::size_t at) const;
  [[nodiscard]] std::span<const std::uint8_t> peek(std::uint64_t at, std::size_t size);
  [[nodiscard]] std::optional<Header> header_at(std::uint64_t at);
  [[nodiscard]] std::optional<Header> certain_header_at(std::uint64_t at);
  [[nodiscard]] bool looks_like_body(std::uint64_t at);
  [[nodiscard]] bool is_interleaved();
  [[nodiscard]] std::optional<std::size_t> owner_of_body();
  std::optional<Error> read_header();
  std::optional<Error> read_body();
  void take_body(std::size_t owner);
  std::optional<Error> resynchronise(const char* fault);
  [[nodiscard]] std::optional<std::uint64_t> find_record(std::uint64_t from);
  std::optional<Error> unfinished(const char* what);
  [[nodiscard]] Error end_of_capture() const;
  void look_for_growth();
  [[nodiscard]] Error damaged(const std::string& what) const;
  [[nodiscard]] std::string left_out() const;

  std::string path_;
  std::unique_ptr<std::istream> file_;
  bool is_gzip_ = false;
  bool is_gzip_damaged_ = false;
  std::vector<std::uint8_t> buffer_;  // of the file, from buffer_at_ on
  std::uint64_t buffer_at_ = 0;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::vector<Header> pending_;  // headers whose bodies come next: one, or two that are interleaved
  std::optional<CaptureRecord> found_;
  std::vector<DamagedBytes> damages_;
  std::uint64_t searched_to_ = 0;  // no record begins before, behind the damage at which the search began
  std::uint64_t skipped_ = 0;
  bool grows_ = false;
  bool big_endian_ = false;
  std::int64_t tick_ns_ = 1000;  ///< of the fraction in a record's time
};

}  // namespace swiftlet
