// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/capture/capture_reader.hpp"
#include "firmware_link/capture/minute_stamps.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// A capture as a link, as fast as it is read: both directions of one vehicle. Stamps that wrap each minute
/// are continued.
class ReplayLink final : public Link {
 public:
  /// Reads the capture once to find its vehicles, and follows one: of those that send log data, in the order
  /// in which they begin to, the one behind `passed_over` others; the last if there are fewer, and where none
  /// does the first vehicle of all. Errors as CaptureReader::open, and kInvalidInput for a capture without a
  /// single packet.
  [[nodiscard]] static Result<std::unique_ptr<ReplayLink>> open(const std::string& path,
                                                                std::size_t passed_over = 0);

  /// Never waits. Errors: kEndOfRecording, kDamaged.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Does nothing: a recording does not answer.
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;

  [[nodiscard]] const CaptureVehicle& followed() const { return followed_; }
  [[nodiscard]] const std::vector<CaptureVehicle>& left_out() const { return left_out_; }
  /// How many vehicles send log data.
  [[nodiscard]] std::size_t senders() const { return senders_.size(); }
  /// For the report: vehicles left out, records skipped.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Share of the file read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  explicit ReplayLink(CaptureReader reader) : reader_(std::move(reader)) {}
  Status survey();
  void choose(std::size_t passed_over);

  CaptureReader reader_;
  CaptureVehicle followed_;
  std::vector<CaptureVehicle> left_out_;  // in order of appearance; before choose() all
  std::vector<CaptureVehicle> senders_;   // of log data, in the order of their first
  std::optional<MinuteStamps> stamps_;    // if its stamps may be of that kind
  std::vector<std::string> notes_;
};

}  // namespace swiftlet
