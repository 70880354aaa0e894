// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <fstream>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/capture_format.hpp"
#include "firmware_link/link.hpp"

namespace swiftlet {

/// Writes what CaptureReader reads: little-endian, microseconds, in the order of the calls. One thread at a
/// time.
class CaptureWriter {
 public:
  /// Creates or empties the file. Errors: kInvalidInput: it cannot be written.
  [[nodiscard]] static Result<CaptureWriter> create(const std::string& path, const CaptureVehicle& vehicle);

  /// Errors: kOutOfSpace: the disk did not take it. Precondition: at most kMaxCrtpPacket bytes.
  [[nodiscard]] Status write(const LinkFrame& frame);
  /// For another vehicle in the same capture.
  void set_vehicle(const CaptureVehicle& vehicle) { vehicle_ = vehicle; }
  /// Hands all to the file system. Errors: kOutOfSpace.
  [[nodiscard]] Status flush();

 private:
  CaptureWriter() = default;
  [[nodiscard]] Status check() const;

  std::string path_;
  std::ofstream file_;
  CaptureVehicle vehicle_;
};

}  // namespace swiftlet
