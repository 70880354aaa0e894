// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/capture/capture_reader.hpp"
#include "firmware_link/capture/minute_stamps.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// A capture as a link, as fast as it is read: both directions of one vehicle. If several vehicles share the
/// capture: of the one whose log data comes first. Stamps that wrap each minute are continued.
class ReplayLink final : public Link {
 public:
  /// Reads the capture once to find its vehicles. Errors as CaptureReader::open, and kInvalidInput for a
  /// capture without a single packet.
  [[nodiscard]] static Result<std::unique_ptr<ReplayLink>> open(const std::string& path);

  /// Never waits. Errors: kEndOfRecording, kDamaged.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Does nothing: a recording does not answer.
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;

  /// For the report: vehicles left out, records skipped.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Share of the file read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  explicit ReplayLink(CaptureReader reader) : reader_(std::move(reader)) {}
  Status survey();

  CaptureReader reader_;
  CaptureVehicle followed_;
  std::optional<MinuteStamps> stamps_;  // if its stamps may be of that kind
  std::vector<std::string> notes_;
};

}  // namespace swiftlet
