// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/file/gzip_lines.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/session/block_description.hpp"
#include "firmware_link/session/device_clock.hpp"

namespace swiftlet {

/// Whether the file is what Bitcraze's cfclient saves of a log block, by its first line. False if it cannot
/// be read.
[[nodiscard]] bool is_client_table(const std::string& path);

/// What Bitcraze's cfclient saves of a log block, as a link that delivers its packets, plain or gzip:
///
///     Timestamp,stateEstimate.x,stateEstimate.y,stateEstimate.yaw,range.front,..
///     15000,0.1,0.2,90.0,1500,..
///
/// Milliseconds of the vehicle's clock, and values in the firmware's units, in any order. Each is sent in
/// four bytes, so a row takes a packet for each group of variables. Frames are stamped with the vehicle's
/// clock. One thread at a time.
class ClientTableLink final : public Link {
 public:
  /// Errors: as size_of_input_file. Precondition: is_client_table().
  [[nodiscard]] static Result<std::unique_ptr<ClientTableLink>> open(const std::string& path);

  /// Of the packets.
  [[nodiscard]] const BlockDescription& description() const { return description_; }
  /// Never waits. Errors: kEndOfRecording. kDamaged: a row that cannot be used; the message names its line.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Does nothing: a recording does not answer.
  [[nodiscard]] Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }

 private:
  ClientTableLink(std::string path, GzipLines lines) : path_(std::move(path)), lines_(std::move(lines)) {}
  void describe(const std::string& variable, std::span<const std::string> all);
  Status read_row();
  /// The packets of a row that hold nothing yet.
  void begin_frames(std::uint32_t counter_ms);

  std::string path_;
  GzipLines lines_;
  BlockDescription description_;
  std::vector<std::string> group_of_block_;
  std::vector<std::uint8_t> block_of_column_;
  DeviceClockUnwrapper clock_;
  std::vector<LinkFrame> frames_;  // of the last row, by block
  std::size_t next_ = 0;
};

}  // namespace swiftlet
