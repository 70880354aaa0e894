// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/capture/capture_format.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// Writes what CaptureReader reads: little-endian, microseconds, in the order of the calls. The file always
/// holds complete records only: a partly written record is truncated. Holds an advisory lock on the file
/// (is_being_written). One thread at a time; allocates when it is opened.
class CaptureWriter {
 public:
  /// Errors: kInvalidInput: it cannot be created, or exists already. kOutOfSpace: not even the file's
  /// header could be written.
  [[nodiscard]] static Result<CaptureWriter> create(const std::string& path, const CaptureVehicle& vehicle);
  /// Writes the rest, without checking that it was written: close() does.
  ~CaptureWriter();
  CaptureWriter(CaptureWriter&& other) noexcept;
  CaptureWriter& operator=(CaptureWriter&& other) = delete;

  /// Keeps the record until flush(), or until the buffer is full. Errors: kOutOfSpace: disk full or failing;
  /// final: every later call returns the same error. Precondition: at most kMaxCrtpPacket bytes.
  [[nodiscard]] Status write(const LinkFrame& frame);
  /// Writes all to the operating system: it survives the end of this process, also by kill -9. Errors: as
  /// write().
  [[nodiscard]] Status flush();
  /// Writes all to the disk: it survives a power failure. Waits for the disk. Nothing may be written
  /// afterwards. Errors: as write().
  [[nodiscard]] Status close();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes of all records written, and of the file's header.
  [[nodiscard]] std::uint64_t size() const { return stored_ + buffer_.size(); }

 private:
  CaptureWriter(std::string path, const CaptureVehicle& vehicle, int file);
  void put(std::uint8_t byte) { buffer_.push_back(byte); }
  void put_u32(std::uint32_t value);
  void put_file_header();
  Status fail(int error_number, std::size_t taken);

  std::string path_;
  CaptureVehicle vehicle_;
  int file_ = -1;
  std::vector<std::uint8_t> buffer_;  // whole records
  std::uint64_t stored_ = 0;          // bytes written to the operating system
  std::optional<Error> failure_;
};

/// Whether a CaptureWriter, of any process, has the file open. False where the file cannot be opened.
[[nodiscard]] bool is_being_written(const std::string& path);

}  // namespace swiftlet
